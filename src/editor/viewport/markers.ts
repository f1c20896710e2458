/**
 * Handles over the canvas: real buttons, so that mouse, touch, keyboard and screen reader use the same thing. One gesture a
 * handle, run by the tool host; what a handle stands for is the thing's kind's affair.
 */
import { html, nothing, render, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import { styleMap } from "lit/directives/style-map.js";
import type { Editor } from "../editor.ts";
import { ARROWS } from "../keys.ts";
import { hasRef, type Ref, sameRef } from "../selection.ts";
import type { Thing } from "../things/thing.ts";
import type { Gesture, ToolPointer } from "../tools/tool.ts";

interface Drag {
  kind: "move" | "turn";
  from: Thing;
  /** Everything that moves with it. */
  along: Thing[];
  text: string;
}

/** Metres that places may be from the room's middle. */
const FARTHEST = 20;
const hold = (v: number): number => Math.max(-FARTHEST, Math.min(FARTHEST, v));
const key = (r: Ref): string => `${r.kind} ${r.id} ${r.index}`;

export class Markers {
  private dragging: Drag | null = null;
  private hovered: Ref | null = null;

  constructor(
    private readonly e: Editor,
    readonly overlay: HTMLElement,
  ) {}

  /** What is being dragged. */
  get dragged(): readonly Ref[] {
    return this.dragging?.along.map((t) => t.ref) ?? [];
  }

  /** Draws the handles where their things are on screen. */
  draw(): void {
    const { selection } = this.e.store.getState();
    const shown = this.e.registry.things
      .filter((k) => k.handle !== "none" && k.shown?.(this.e) !== false)
      .flatMap((k) => {
        if (k.handle === "selected" && !selection.some((r) => r.kind === k.kind)) return [];
        return k
          .list(this.e)
          .map((thing, index) => ({ thing, index, dot: k.handle !== "ball" }))
          .filter((s) => k.handle !== "selected" || hasRef(selection, s.thing.ref));
      });
    render(
      html`${repeat(
        shown,
        (s) => key(s.thing.ref),
        (s) => this.marker(s.thing, s.index, s.dot, hasRef(selection, s.thing.ref)),
      )}${this.ghost()}${this.cross()}${this.tip(shown.map((s) => s.thing))}`,
      this.overlay,
    );
  }

  private at(t: Thing): { x: number; y: number; visible: boolean } {
    return this.e.stage.project(t.position[0], Math.max(0.05, t.position[1]), t.position[2]);
  }

  /** Where a drag began, and the way from there. */
  private ghost(): TemplateResult | typeof nothing {
    const d = this.dragging;
    if (d?.kind !== "move" || d.text === "") return nothing;
    const from = this.at(d.from);
    const now = this.now(d.from.ref);
    const to = now ? this.at(now) : from;
    return html`<svg class="way" aria-hidden="true"><line x1=${from.x} y1=${from.y} x2=${to.x} y2=${to.y} /><circle cx=${from.x} cy=${from.y} r="11" /></svg>`;
  }

  /** The cross that arrows move over the floor. */
  private cross(): TemplateResult | typeof nothing {
    const { place } = this.e.tools.cursor;
    if (!place) return nothing;
    const { x, y } = this.e.stage.project(place[0], 0.01, place[1]);
    return html`<svg class="cross" aria-hidden="true" viewBox="-12 -12 24 24" style=${styleMap({ transform: `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)` })}><path d="M-11 0H11M0-11V11" /><path d="M-11 0H11M0-11V11" /><circle r="5" /></svg>`;
  }

  private tip(things: readonly Thing[]): TemplateResult | typeof nothing {
    const r = this.dragging?.from.ref ?? this.hovered;
    const t = r ? things.find((x) => sameRef(x.ref, r)) : undefined;
    if (!t) return nothing;
    const at = this.at(t);
    const style = styleMap({
      transform: `translate(${Math.round(at.x + 26)}px, ${Math.round(at.y - 12)}px)`,
    });
    const hint = this.e.registry.thing(t.ref.kind)?.hint;
    return this.dragging
      ? html`<div class="tip" style=${style}>${this.dragging.text}<i>Esc undoes</i></div>`
      : html`<div class="tip" style=${style}>${t.label}${hint ? `. ${hint}` : ""}${t.yaw !== null ? html`<i>R turns</i>` : nothing}</div>`;
  }

  private marker(t: Thing, index: number, dot: boolean, selected: boolean): TemplateResult {
    const { stage } = this.e;
    const [x, , z] = t.position;
    const y = Math.max(0.05, t.position[1]);
    const at = this.at(t);
    const noun = this.e.registry.thing(t.ref.kind)?.noun ?? t.ref.kind;
    const classes = [
      "marker",
      dot ? "dot" : "",
      selected ? "selected" : "",
      this.dragging && sameRef(this.dragging.from.ref, t.ref) ? "dragging" : "",
    ].join(" ");
    // The tick stands on the side the character faces, as it is seen.
    const tick = (yaw: number): TemplateResult => {
      const ahead = stage.project(x + 0.2 * Math.sin(yaw), y, z + 0.2 * Math.cos(yaw));
      const angle = Math.atan2(ahead.x - at.x, at.y - ahead.y);
      return html`<span class="tick" style=${styleMap({ transform: `rotate(${angle.toFixed(3)}rad) translateY(-21px)` })} @pointerdown=${(ev: PointerEvent) => this.begin(ev, t, "turn")}></span>`;
    };
    return html`<button
      class=${classes}
      data-marker=${t.ref.id}
      data-kind=${t.ref.kind}
      data-index=${t.ref.index}
      aria-label="${noun} ${index + 1}: ${t.label}, at ${x.toFixed(2)}, ${z.toFixed(2)} metres. Arrows move, ${t.yaw !== null ? "R turns, " : ""}Delete removes."
      aria-pressed=${selected}
      style=${styleMap({ transform: `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`, visibility: at.visible ? "visible" : "hidden" })}
      @pointerdown=${(ev: PointerEvent) => this.begin(ev, t, "move")}
      @dblclick=${() => this.e.registry.thing(t.ref.kind)?.activate?.(this.e, t.ref)}
      @pointerenter=${() => this.hover(t.ref)}
      @pointerleave=${() => this.hover(null)}
      @focus=${() => this.focused(t.ref)}
      @keydown=${(ev: KeyboardEvent) => this.key(ev, t.ref)}
    ><span class="ball">${dot ? nothing : t.icon}</span>${t.yaw !== null ? tick(t.yaw) : nothing}</button>`;
  }

  private hover(r: Ref | null): void {
    this.hovered = r;
    this.draw();
  }

  /** Focus selects, unless the thing is already one of several selected. */
  private focused(r: Ref): void {
    if (!hasRef(this.e.store.getState().selection, r)) this.e.scene.select([r], false);
  }

  /** The thing as it is now: what was drawn may be older than the last event. */
  private now(r: Ref): Thing | undefined {
    return this.e.things().find((t) => sameRef(t.ref, r));
  }

  private begin(ev: PointerEvent, drawn: Thing, kind: Drag["kind"]): void {
    if (ev.button !== 0 || this.dragging || this.e.tools.busy) return;
    ev.stopPropagation();
    ev.preventDefault();
    const from = this.now(drawn.ref);
    if (!from) return;
    const { selection } = this.e.store.getState();
    if (ev.shiftKey) {
      this.e.scene.toggle(from.ref);
      return;
    }
    const together = hasRef(selection, from.ref) && kind === "move";
    if (!together) this.e.scene.select([from.ref]);
    (ev.currentTarget as HTMLElement).closest("button")?.focus({ preventScroll: true });
    const gesture = this.drag(from.ref, kind, this.e.tools.pointer(ev));
    if (gesture) this.e.tools.run(gesture, ev);
  }

  /** A drag of a thing, with everything selected along; null when the pointer is over nothing. */
  drag(r: Ref, kind: Drag["kind"], p: ToolPointer): Gesture | null {
    const from = this.now(r);
    const height = Math.max(0, from?.position[1] ?? 0);
    const origin = p.level(height);
    if (!from || !origin) return null;
    const { selection } = this.e.store.getState();
    const moving = hasRef(selection, r) ? selection : [r];
    const drag: Drag = {
      kind,
      from,
      along: this.e.things().filter((t) => hasRef(moving, t.ref)),
      text: "",
    };
    this.dragging = drag;
    return this.gesture(drag, origin, height);
  }

  private gesture(d: Drag, origin: [number, number], height: number): Gesture {
    const { e } = this;
    const [x, , z] = d.from.position;
    e.layers.update("selection");
    const stop = (): undefined => {
      this.dragging = null;
      e.layers.update("selection");
    };
    return {
      move: (p) => {
        const point = p.level(height);
        if (!point) return;
        if (d.kind === "turn") {
          const yaw = e.snappedYaw(Math.atan2(point[0] - x, point[1] - z), p.event);
          d.text = `${Math.round((yaw * 180) / Math.PI)}°`.replace("-", "\u2212");
          e.edit((scene) => this.placed(scene, [d.from], 0, 0, yaw));
          return;
        }
        const to = e.snapped([x + point[0] - origin[0], z + point[1] - origin[1]], p.event);
        const dx = hold(to[0]) - x;
        const dz = hold(to[1]) - z;
        const facing = d.from.yaw === null ? "" : `, facing ${Math.round((d.from.yaw * 180) / Math.PI)}°`;
        d.text = `${Math.hypot(dx, dz).toFixed(2)} m${facing}`.replace("-", "\u2212");
        e.edit((scene) => this.placed(scene, d.along, dx, dz, null));
      },
      up: stop,
      cancel: stop,
    };
  }

  /** Things moved from where they were; `yaw` null leaves their facing. */
  private placed(
    scene: Parameters<Parameters<Editor["edit"]>[0]>[0],
    things: readonly Thing[],
    dx: number,
    dz: number,
    yaw: number | null,
  ) {
    return things.reduce((s, t) => {
      const [x, y, z] = t.position;
      return this.e.registry.thing(t.ref.kind)?.place(s, t.ref, [x + dx, y, z + dz], yaw ?? t.yaw ?? 0) ?? s;
    }, scene);
  }

  private key(ev: KeyboardEvent, r: Ref): void {
    const { e } = this;
    if (ev.ctrlKey || ev.metaKey) return;
    if (e.registry.thing(r.kind)?.keydown?.(e, r, ev)) {
      ev.preventDefault();
      ev.stopPropagation();
      return;
    }
    const step = ev.altKey ? 0.01 : ev.shiftKey ? 0.25 : 0.05;
    const nudge = ARROWS[ev.key];
    if (nudge) {
      ev.preventDefault();
      ev.stopPropagation();
      e.scene.nudge(nudge[0] * step, nudge[1] * step, 0);
    } else if (ev.key.toLowerCase() === "r") {
      ev.stopPropagation();
      e.scene.nudge(0, 0, ((ev.shiftKey ? -1 : 1) * Math.PI) / 12);
    } else if (ev.key === "Enter") {
      ev.preventDefault();
      e.scene.select([r]);
    }
  }
}
