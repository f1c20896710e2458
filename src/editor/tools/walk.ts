/**
 * Walking by wish: keys, the pointer or a gamepad say how fast and which way, a worker makes the footsteps and the motion
 * (root control, lambda_4 = 1). The scene stays as it is; leaving the tool shows its plan again.
 */
import { html, svg } from "lit";
import type { WalkRequest, WalkResponse } from "../../workers/walk-protocol.ts";
import type { Editor } from "../editor.ts";
import type { Tool } from "./tool.ts";

const WALK_ICON = html`<svg viewBox="0 0 18 18" aria-hidden="true">${svg`<circle cx="9" cy="9" r="6.500" /><circle cx="9" cy="9" r="2" /><path d="M9 1.200v3M9 13.800v3M1.200 9h3M13.800 9h3" />`}</svg>`;

/** Speeds, m/s and rad/s. */
const WALK = 1.2;
const RUN = 2.8;
const BACK = 0.55;
const SIDE = 0.3;
const TURN = 1.3;
/** A pointer this near asks for nothing; speed grows to WALK at this distance, metres. */
const NEAR = 0.25;
const FAR = 1.4;
const DEAD = 0.18;

const KEYS = ["w", "a", "s", "d", "q", "e", "arrowup", "arrowdown", "arrowleft", "arrowright"];

class WalkMode {
  private worker: Worker | null = null;
  private readonly down = new Set<string>();
  private target: [number, number] | null = null;
  private place: [number, number, number] = [0, 0, 0];
  private frame = 0;
  private asked = "";

  constructor(private readonly e: Editor) {}

  enter(): void {
    const { e } = this;
    e.playback.setPlaying(false);
    const { scene } = e.store.getState();
    const worker = new Worker(new URL("../../workers/walk-worker.ts", import.meta.url), { type: "module" });
    this.worker = worker;
    worker.onmessage = (event: MessageEvent<WalkResponse>) => this.hear(event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      e.fail("The walk stopped. Take the tool up again.");
      e.tools.use("select");
    };
    const m = e.plan.motion.current;
    const { time } = e.store.getState();
    const f = m ? Math.max(0, Math.min(m.filled - 1, Math.floor(60 * time))) : -1;
    const at = m && f >= 0 ? [m.root[3 * f], m.root[3 * f + 2]] : scene.start.position;
    this.send({
      type: "start",
      height: scene.character.height,
      proportions: scene.character.proportions,
      place: { x: at[0], z: at[1], yaw: scene.start.yaw },
      terrain: scene.terrain,
    });
    e.set({ status: "Getting ready to walk" });
    window.addEventListener("keyup", this.keyup);
    window.addEventListener("blur", this.letGo);
    this.frame = requestAnimationFrame(() => this.poll());
  }

  leave(): void {
    window.removeEventListener("keyup", this.keyup);
    window.removeEventListener("blur", this.letGo);
    cancelAnimationFrame(this.frame);
    this.worker?.terminate();
    this.worker = null;
    this.down.clear();
    this.target = null;
    this.asked = "";
    this.e.set({ status: null });
    this.e.playback.show();
  }

  private readonly keyup = (ev: KeyboardEvent): void => {
    this.down.delete(ev.key.toLowerCase());
    if (ev.key === "Shift") this.down.delete("shift");
  };

  private readonly letGo = (): void => {
    this.down.clear();
  };

  key(ev: KeyboardEvent): boolean {
    const key = ev.key.toLowerCase();
    if (ev.ctrlKey || ev.metaKey || !KEYS.includes(key)) return false;
    this.down.add(key);
    if (ev.shiftKey) this.down.add("shift");
    return true;
  }

  aim(at: [number, number] | null): void {
    this.target = at;
  }

  private send(m: WalkRequest): void {
    this.worker?.postMessage(m);
  }

  private hear(m: WalkResponse): void {
    if (m.type === "ready") {
      this.e.set({ status: "W, S walk; A, D turn; Q, E step aside; Shift runs" });
      document.documentElement.dataset.walk = "ready";
    } else if (m.type === "failed") this.e.fail(m.message);
    else {
      this.place = m.place;
      this.e.stage.setPose(m.root, 0, m.rotations, 0);
      this.e.stage.invalidate();
      document.documentElement.dataset.walk = m.place.map((v) => v.toFixed(2)).join(" ");
    }
  }

  /** What is wanted now: keys, else the pointer, else the first gamepad. */
  private wish(): [number, number, number] {
    const on = (...keys: string[]): number => (keys.some((k) => this.down.has(k)) ? 1 : 0);
    const ahead = on("w", "arrowup") * (this.down.has("shift") ? RUN : WALK) - on("s", "arrowdown") * BACK;
    const turn = TURN * (on("a", "arrowleft") - on("d", "arrowright"));
    const aside = SIDE * (on("q") - on("e"));
    if (ahead !== 0 || turn !== 0 || aside !== 0) return [aside, ahead, turn];
    if (this.target) {
      const [x, z, yaw] = this.place;
      const dx = this.target[0] - x;
      const dz = this.target[1] - z;
      const far = Math.hypot(dx, dz);
      if (far < NEAR) return [0, 0, 0];
      const off = Math.atan2(Math.sin(Math.atan2(dx, dz) - yaw), Math.cos(Math.atan2(dx, dz) - yaw));
      const speed = WALK * Math.min(1, far / FAR) * Math.max(0, Math.cos(off));
      return [0, speed, Math.max(-TURN, Math.min(TURN, 1.6 * off))];
    }
    const pad = navigator.getGamepads?.().find((p) => p?.connected);
    if (!pad) return [0, 0, 0];
    const axis = (k: number): number => (Math.abs(pad.axes[k] ?? 0) < DEAD ? 0 : (pad.axes[k] ?? 0));
    const forward = -axis(1) * (axis(1) < 0 ? (pad.buttons[0]?.pressed ? RUN : WALK) : BACK);
    return [-axis(0) * SIDE, forward, -axis(2) * TURN];
  }

  private poll(): void {
    const [lateral, forward, turn] = this.wish();
    const text = `${lateral} ${forward} ${turn}`;
    if (text !== this.asked) {
      if (this.asked !== "" && document.documentElement.dataset.walk) this.e.set({ status: null });
      this.asked = text;
      this.send({ type: "wish", lateral, forward, turn });
    }
    this.frame = requestAnimationFrame(() => this.poll());
  }
}

const modes = new WeakMap<Editor, WalkMode>();
function modeOf(e: Editor): WalkMode {
  const mode = modes.get(e) ?? new WalkMode(e);
  modes.set(e, mode);
  return mode;
}

export const walkTool: Tool = {
  id: "walk",
  label: "Walk by hand",
  icon: WALK_ICON,
  key: "W",
  order: 35,
  cursor: "crosshair",
  enter: (e) => modeOf(e).enter(),
  leave: (e) => modeOf(e).leave(),
  keydown: (e, ev) => modeOf(e).key(ev),
  down(e, p) {
    const mode = modeOf(e);
    mode.aim(p.level(0));
    return {
      plain: true,
      move: (m) => mode.aim(m.level(0)),
      up() {
        mode.aim(null);
        return true;
      },
      cancel: () => mode.aim(null),
    };
  },
};
