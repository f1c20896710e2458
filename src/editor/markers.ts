/**
 * Task markers over the canvas: real buttons, so that mouse, touch, keyboard and screen reader use the same thing. One
 * gesture a marker: begin, move from the snapshot, commit; Escape bails out.
 */
import { html, nothing, render, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import { styleMap } from "lit/directives/style-map.js";
import type { SceneTask } from "../core/scene/types.ts";
import type { Editor } from "./editor.ts";
import { TASK_ICONS, TASK_WORDS } from "./icons.ts";

interface Drag {
  id: string;
  kind: "move" | "turn";
  from: SceneTask;
  /** Pointer's level point where it began. */
  origin: [number, number];
  text: string;
}

export class Markers {
  private drag: Drag | null = null;
  private hovered: string | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly overlay: HTMLElement,
  ) {}

  /** Draws the markers where their tasks are on screen. */
  draw(): void {
    const { scene, selected } = this.editor.store.getState();
    const tasks = scene.order.flatMap((id) => scene.tasks.find((t) => t.id === id) ?? []);
    render(
      html`${repeat(
        tasks,
        (t) => t.id,
        (t, i) => this.marker(t, i, t.id === selected),
      )}${this.tip(tasks)}`,
      this.overlay,
    );
  }

  private tip(tasks: readonly SceneTask[]): TemplateResult | typeof nothing {
    const t = tasks.find((x) => x.id === (this.drag?.id ?? this.hovered));
    if (!t) return nothing;
    const at = this.editor.stage.project(t.position[0], Math.max(0.05, t.position[1]), t.position[2]);
    const style = styleMap({
      transform: `translate(${Math.round(at.x + 26)}px, ${Math.round(at.y - 12)}px)`,
    });
    return this.drag
      ? html`<div class="tip" style=${style}>${this.drag.text}</div>`
      : html`<div class="tip" style=${style}>${TASK_WORDS[t.category]}. Drag to move<i>R turns</i></div>`;
  }

  private marker(t: SceneTask, index: number, selected: boolean): TemplateResult {
    const { stage } = this.editor;
    const y = Math.max(0.05, t.position[1]);
    const at = stage.project(t.position[0], y, t.position[2]);
    // The tick stands on the side the character faces, as it is seen.
    const ahead = stage.project(
      t.position[0] + 0.2 * Math.sin(t.yaw),
      y,
      t.position[2] + 0.2 * Math.cos(t.yaw),
    );
    const angle = Math.atan2(ahead.x - at.x, at.y - ahead.y);
    return html`<button
      class="marker ${selected ? "selected" : ""} ${this.drag?.id === t.id ? "dragging" : ""}"
      data-marker=${t.id}
      aria-label="Task ${index + 1}: ${TASK_WORDS[t.category]}, at ${t.position[0].toFixed(2)}, ${t.position[2].toFixed(2)} metres. Arrows move, R turns, Delete removes."
      aria-pressed=${selected}
      style=${styleMap({ transform: `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`, visibility: at.visible ? "visible" : "hidden" })}
      @pointerdown=${(e: PointerEvent) => this.begin(e, t, "move")}
      @pointerenter=${() => this.hover(t.id)}
      @pointerleave=${() => this.hover(null)}
      @focus=${() => this.editor.select(t.id, false)}
      @keydown=${(e: KeyboardEvent) => this.key(e, t)}
    >
      <span class="ball">${TASK_ICONS[t.category]}</span>
      <span class="tick" style=${styleMap({ transform: `rotate(${angle.toFixed(3)}rad) translateY(-21px)` })} @pointerdown=${(e: PointerEvent) => this.begin(e, t, "turn")}></span>
    </button>`;
  }

  private hover(id: string | null): void {
    this.hovered = id;
    this.draw();
  }

  private begin(e: PointerEvent, drawn: SceneTask, kind: Drag["kind"]): void {
    const t = this.editor.store.getState().scene.tasks.find((x) => x.id === drawn.id) ?? drawn;
    if (e.button !== 0 || this.drag) return;
    e.stopPropagation();
    e.preventDefault();
    const point = this.point(e, Math.max(0, t.position[1]));
    (e.currentTarget as HTMLElement).closest("button")?.focus({ preventScroll: true });
    this.editor.select(t.id, true);
    if (!point) return;
    this.drag = { id: t.id, kind, from: t, origin: point, text: "" };
    this.editor.beginGesture();
    const move = (m: PointerEvent) => this.move(m);
    const end = (commit: boolean) => {
      window.removeEventListener("pointermove", move);
      window.removeEventListener("pointerup", up);
      window.removeEventListener("pointercancel", cancel);
      window.removeEventListener("keydown", bail, true);
      this.drag = null;
      this.editor.endGesture(commit);
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
    return this.editor.stage.levelPoint(e.clientX - box.left, e.clientY - box.top, height);
  }

  private move(e: PointerEvent): void {
    const d = this.drag;
    if (!d) return;
    const point = this.point(e, Math.max(0, d.from.position[1]));
    if (!point) return;
    const [x, y, z] = d.from.position;
    if (d.kind === "move") {
      const clamp = (v: number) => Math.max(-20, Math.min(20, v));
      const to: [number, number, number] = [
        clamp(x + point[0] - d.origin[0]),
        y,
        clamp(z + point[1] - d.origin[1]),
      ];
      d.text = `${Math.hypot(to[0] - x, to[2] - z).toFixed(2)} m`;
      this.editor.edit((scene, c) => c.placeTask(scene, d.id, to, d.from.yaw));
    } else {
      let yaw = Math.atan2(point[0] - x, point[1] - z);
      if (!e.shiftKey) yaw = Math.round(yaw / (Math.PI / 12)) * (Math.PI / 12);
      d.text = `${Math.round((yaw * 180) / Math.PI)}°`.replace("-", "\u2212");
      this.editor.edit((scene, c) => c.placeTask(scene, d.id, d.from.position, yaw));
    }
  }

  private key(e: KeyboardEvent, drawn: SceneTask): void {
    // What was drawn may be older than the last key.
    const t = this.editor.store.getState().scene.tasks.find((x) => x.id === drawn.id) ?? drawn;
    const step = e.altKey ? 0.01 : e.shiftKey ? 0.25 : 0.05;
    const away: Record<string, [number, number]> = {
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
      ArrowLeft: [1, 0],
      ArrowRight: [-1, 0],
    };
    const nudge = away[e.key];
    if (nudge) {
      e.preventDefault();
      e.stopPropagation();
      this.editor.edit((scene, c) =>
        c.placeTask(
          scene,
          t.id,
          [t.position[0] + nudge[0] * step, t.position[1], t.position[2] + nudge[1] * step],
          t.yaw,
        ),
      );
    } else if (e.key === "r" || e.key === "R") {
      e.stopPropagation();
      this.editor.edit((scene, c) =>
        c.placeTask(scene, t.id, t.position, t.yaw + ((e.shiftKey ? -1 : 1) * Math.PI) / 12),
      );
    } else if (e.key === "Enter") this.editor.select(t.id, true);
  }
}
