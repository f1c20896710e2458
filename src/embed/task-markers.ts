/** Task markers over the picture: real buttons that mouse, touch, keyboard and screen readers share. A drag is one entry of undo. */
import { placeTask } from "../core/scene/commands.ts";
import type { SceneTask } from "../core/scene/types.ts";
import { el, setAttributes } from "./dom.ts";
import { TASK_WORDS, taskIcon } from "./icons.ts";
import type { Player } from "./player.ts";
import type { SceneView } from "./scene-view.ts";

/** Farthest that a task may be dragged from the middle, metres. */
const MOST = 20;
const STEP = 0.05;
const TURN = Math.PI / 12;

interface Marker {
  button: HTMLButtonElement;
  tick: HTMLElement;
}

export class TaskMarkers {
  readonly overlay = el("div", { class: "overlay" });
  private readonly tip = el("div", { class: "tip", hidden: true });
  private readonly markers = new Map<string, Marker>();
  private stage: SceneView | null = null;
  private tipFor: string | null = null;
  private drag: { id: string; from: SceneTask; origin: [number, number]; turn: boolean } | null = null;

  constructor(
    private readonly player: Player,
    private readonly failed: (message: string) => void,
  ) {
    this.overlay.append(this.tip);
  }

  attach(stage: SceneView | null): void {
    this.stage = stage;
  }

  /** Puts the markers where their tasks are on screen. */
  draw(): void {
    const { stage } = this;
    if (!stage) return;
    const { scene } = this.player;
    const tasks = scene.order.flatMap((id) => scene.tasks.find((t) => t.id === id) ?? []);
    for (const [id, m] of this.markers)
      if (!tasks.some((t) => t.id === id)) {
        m.button.remove();
        this.markers.delete(id);
      }
    tasks.forEach((t, i) => {
      let m = this.markers.get(t.id);
      if (!m) {
        m = this.create(t);
        this.markers.set(t.id, m);
        this.overlay.insertBefore(m.button, this.tip);
      }
      this.put(stage, m, t, i);
    });
    this.drawTip();
  }

  private put(stage: SceneView, m: Marker, t: SceneTask, index: number): void {
    const y = Math.max(0.05, t.position[1]);
    const at = stage.project(t.position[0], y, t.position[2]);
    const ahead = stage.project(
      t.position[0] + 0.2 * Math.sin(t.yaw),
      y,
      t.position[2] + 0.2 * Math.cos(t.yaw),
    );
    m.button.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
    m.button.style.visibility = at.visible ? "visible" : "hidden";
    m.tick.style.transform = `rotate(${Math.atan2(ahead.x - at.x, at.y - ahead.y).toFixed(3)}rad) translateY(-22px)`;
    setAttributes(m.button, {
      "aria-label": `Task ${index + 1}: ${TASK_WORDS[t.category]}, at ${t.position[0].toFixed(2)}, ${t.position[2].toFixed(2)} metres. Arrow keys move it, R turns it.`,
    });
  }

  private create(task: SceneTask): Marker {
    const { id } = task;
    const tick = el("span", { class: "tick" });
    const button = el(
      "button",
      { class: "marker", type: "button", "data-marker": id },
      el("span", { class: "ball" }, taskIcon(task.category)),
      tick,
    );
    button.addEventListener("pointerdown", (e) => this.begin(e, id, e.target === tick));
    button.addEventListener("pointerenter", () => this.setTip(id));
    button.addEventListener("pointerleave", () => this.setTip(null));
    button.addEventListener("focus", () => this.player.select(id));
    button.addEventListener("blur", () => this.player.select(null));
    button.addEventListener("keydown", (e) => this.key(e, id));
    return { button, tick };
  }

  private setTip(id: string | null): void {
    this.tipFor = id;
    this.drawTip();
  }

  private drawTip(): void {
    const t = this.task(this.drag?.id ?? this.tipFor ?? "");
    this.tip.hidden = !t || !this.stage;
    if (!t || !this.stage) return;
    const at = this.stage.project(t.position[0], Math.max(0.05, t.position[1]), t.position[2]);
    this.tip.textContent = this.drag ? this.readout(this.drag.from, t) : `Drag ${TASK_WORDS[t.category]}`;
    // On the side where there is room.
    const width = this.tip.offsetWidth;
    const x = at.x + 26 + width > this.overlay.clientWidth ? at.x - 26 - width : at.x + 26;
    this.tip.style.transform = `translate(${Math.round(x)}px, ${Math.round(at.y - 13)}px)`;
  }

  private readout(from: SceneTask, to: SceneTask): string {
    if (this.drag?.turn) return `${Math.round((to.yaw * 180) / Math.PI)}°`.replace("-", "\u2212");
    return `${Math.hypot(to.position[0] - from.position[0], to.position[2] - from.position[2]).toFixed(2)} m`;
  }

  private task(id: string): SceneTask | undefined {
    return this.player.scene.tasks.find((t) => t.id === id);
  }

  private place(id: string, x: number, z: number, yaw: number): void {
    const t = this.task(id);
    if (!t) return;
    const clamp = (v: number) => Math.max(-MOST, Math.min(MOST, v));
    try {
      this.player.edit((scene) => placeTask(scene, id, [clamp(x), t.position[1], clamp(z)], yaw));
    } catch (error) {
      this.failed(error instanceof Error ? error.message : String(error));
    }
  }

  private begin(e: PointerEvent, id: string, turn: boolean): void {
    const from = this.task(id);
    const point = from && this.point(e, Math.max(0, from.position[1]));
    if (e.button !== 0 || this.drag || !from || !point) return;
    e.preventDefault();
    e.stopPropagation();
    const { button } = this.markers.get(id) as Marker;
    button.focus({ preventScroll: true });
    button.classList.add("dragging");
    this.drag = { id, from, origin: point, turn };
    this.player.beginDrag();
    const move = (m: PointerEvent) => this.move(m);
    const end = (keep: boolean) => {
      window.removeEventListener("pointermove", move);
      window.removeEventListener("pointerup", up);
      window.removeEventListener("pointercancel", cancel);
      window.removeEventListener("keydown", bail, true);
      button.classList.remove("dragging");
      this.drag = null;
      this.player.endDrag(keep);
      this.draw();
    };
    const up = () => end(true);
    const cancel = () => end(false);
    const bail = (k: KeyboardEvent) => {
      if (k.key !== "Escape") return;
      k.stopPropagation();
      end(false);
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", up);
    window.addEventListener("pointercancel", cancel);
    window.addEventListener("keydown", bail, true);
  }

  private point(e: PointerEvent, height: number): [number, number] | null {
    const box = this.overlay.getBoundingClientRect();
    return this.stage?.levelPoint(e.clientX - box.left, e.clientY - box.top, height) ?? null;
  }

  private move(e: PointerEvent): void {
    const d = this.drag;
    const point = d && this.point(e, Math.max(0, d.from.position[1]));
    if (!d || !point) return;
    const [x, , z] = d.from.position;
    if (d.turn) {
      const yaw = Math.atan2(point[0] - x, point[1] - z);
      this.place(d.id, x, z, e.shiftKey ? yaw : Math.round(yaw / TURN) * TURN);
    } else this.place(d.id, x + point[0] - d.origin[0], z + point[1] - d.origin[1], d.from.yaw);
  }

  private key(e: KeyboardEvent, id: string): void {
    const t = this.task(id);
    if (!t) return;
    const step = e.altKey ? STEP / 5 : e.shiftKey ? 5 * STEP : STEP;
    // The viewer looks along +Z: what is right on screen is -X.
    const away: Record<string, [number, number]> = {
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
      ArrowLeft: [1, 0],
      ArrowRight: [-1, 0],
    };
    const nudge = away[e.key];
    const turn = e.key === "r" || e.key === "R";
    if (!nudge && !turn) return;
    e.preventDefault();
    e.stopPropagation();
    const [dx, dz] = nudge ?? [0, 0];
    this.place(
      id,
      t.position[0] + dx * step,
      t.position[2] + dz * step,
      t.yaw + (turn ? (e.shiftKey ? -TURN : TURN) : 0),
    );
  }
}
