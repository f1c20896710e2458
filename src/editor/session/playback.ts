/** The clock: playing, seeking, stepping; tells the layers what time is shown. */
import { elapsed } from "../../core/math/elapsed.ts";
import { crowdAlone, crowdSession } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";

export class Playback {
  private lastTick = 0;

  constructor(private readonly e: Editor) {}

  /** Shows the present time. */
  show(): void {
    this.e.layers.time(this.e.store.getState().time);
  }

  setPlaying(playing: boolean): void {
    const s = this.e.store.getState();
    if (playing && s.time >= this.e.plan.duration - 0.02) this.e.set({ time: 0 });
    this.e.set({ playing });
    if (playing && !s.playing) {
      this.lastTick = performance.now();
      requestAnimationFrame(() => this.tick());
    }
  }

  /** Plays or pauses what the scene is about: the motion, or its crowd where there is nothing else. */
  toggle(): void {
    if (crowdAlone(this.e.store.getState().scene)) {
      const crowd = crowdSession(this.e);
      if (crowd.ready) crowd.setRunning(!crowd.running);
      return;
    }
    this.setPlaying(!this.e.store.getState().playing);
  }

  private tick(): void {
    const s = this.e.store.getState();
    if (!s.playing) return;
    const now = performance.now();
    const passed = elapsed(this.lastTick, now);
    this.lastTick = now;
    let time = s.time + passed * s.speed;
    const { duration } = this.e.plan;
    const m = this.e.plan.motion.current;
    if (m && m.filled < m.frames) time = Math.min(time, (m.filled - 1) / 60);
    if (time >= duration) {
      if (s.loop && !this.e.scene.inGesture) {
        time = 0;
        this.e.layers.update("scene");
      } else {
        time = duration;
        this.e.set({ playing: false });
      }
    }
    this.e.set({ time });
    this.show();
    requestAnimationFrame(() => this.tick());
  }

  seek(time: number): void {
    const before = this.e.store.getState().time;
    this.e.set({ time: Math.max(0, Math.min(this.e.plan.duration, time)), playing: false });
    // Boxes go back to where they stood.
    if (time < before) this.e.layers.update("scene");
    this.show();
  }

  stepFrame(by: number): void {
    this.seek(Math.round(this.e.store.getState().time * 60 + by) / 60);
  }

  /** To the landing of the next footstep, or of the one before. */
  stepFootstep(by: 1 | -1): void {
    const { plan, time } = this.e.store.getState();
    const lands = (plan?.steps ?? []).map((p) => p.land).sort((a, b) => a - b);
    const next = by > 0 ? lands.find((t) => t > time + 0.01) : lands.reverse().find((t) => t < time - 0.01);
    if (next !== undefined) this.seek(next);
  }

  toggleLoop(): void {
    this.e.set({ loop: !this.e.store.getState().loop });
  }

  setSpeed(speed: number): void {
    this.e.set({ speed });
  }
}
