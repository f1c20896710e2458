/** Plays a walk on the stage, over and over; a walk that takes another's place goes on at the same share of its way. */

import { CLIP_RATE } from "../core/capture/clip.ts";
import { elapsed } from "../core/math/elapsed.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import type { Stage } from "../view/stage.ts";
import type { Walked } from "../workers/studio-protocol.ts";

/** Seconds that the person stands at the end before the walk begins anew. */
const REST = 0.7;

export class Player {
  private walk: Walked | null = null;
  private time = 0;
  private last = 0;
  private printed = "";
  playing = true;

  constructor(private readonly stage: Stage) {
    const tick = (now: number) => {
      const dt = elapsed(this.last, now);
      this.last = now;
      if (this.playing && this.walk && document.visibilityState === "visible") {
        this.time += dt;
        if (this.time > this.length + REST) this.time = 0;
        this.show();
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  get length(): number {
    return this.walk ? (this.walk.frames - 1) / CLIP_RATE : 0;
  }

  set(walk: Walked): void {
    const share = this.walk ? Math.min(1, this.time / this.length) : 0.3;
    const first = this.walk === null;
    this.walk = walk;
    this.time = share * this.length;
    this.printed = "";
    if (first) this.frame();
    this.show();
  }

  /** Brings the whole way into view. */
  frame(): void {
    if (!this.walk) return;
    const points = this.walk.steps.map((s) => [s.x, 0, s.z] as const);
    this.stage.frame(points);
  }

  show(): void {
    const { walk } = this;
    if (!walk) return;
    const x = Math.min(walk.frames - 1, this.time * CLIP_RATE);
    const f = Math.round(x);
    this.stage.setPose(walk.root, 3 * f, walk.rotations, 4 * JOINT_COUNT * f);
    const on = this.standing(walk);
    const key = `${on.left} ${on.right}`;
    if (key === this.printed) return;
    this.printed = key;
    this.stage.setFootprints(
      walk.steps.map((s, i) => ({
        foot: s.foot,
        x: s.x,
        y: 0,
        z: s.z,
        yaw: s.yaw,
        category: s.category,
        phase: null,
        state: i < on[s.foot] ? "past" : i === on[s.foot] ? "now" : "next",
      })),
      "category",
    );
  }

  /** Index of each foot's step that it is in or rests from. */
  private standing(walk: Walked): Record<"left" | "right", number> {
    const on = { left: 0, right: 1 };
    walk.steps.forEach((s, i) => {
      if (i > 1 && s.lift <= this.time) on[s.foot] = i;
    });
    return on;
  }
}
