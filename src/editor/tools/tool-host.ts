/** Hands the viewport's pointer and keys to the tool at hand, and runs gestures from their mark to their end. */
import type { Editor } from "../editor.ts";
import { FloorCursor } from "./floor-cursor.ts";
import type { Gesture, Tool, ToolPointer } from "./tool.ts";

export class ToolHost {
  readonly cursor: FloorCursor;
  private gesture: { gesture: Gesture; end(commit: boolean): void } | null = null;

  constructor(
    private readonly e: Editor,
    private readonly canvas: HTMLElement,
  ) {
    this.cursor = new FloorCursor(e);
    // Before the camera's own listener: what a tool takes does not orbit.
    canvas.addEventListener("pointerdown", (ev) => this.down(ev), { capture: true });
    canvas.addEventListener("pointermove", (ev) => {
      if (!this.gesture && ev.buttons === 0) this.current.hover?.(this.e, this.pointer(ev));
    });
    canvas.addEventListener("pointerleave", () => this.e.hoverStep(-1));
  }

  get all(): readonly Tool[] {
    return this.e.registry.tools;
  }

  get current(): Tool {
    const { tool } = this.e.store.getState();
    return this.all.find((t) => t.id === tool) ?? this.all[0];
  }

  /** Whether a drag is under way. */
  get busy(): boolean {
    return this.gesture !== null;
  }

  /** Takes a tool up; `choice` null leaves the tool's last or first choice. Gestures under way are given up. */
  use(id: string, choice: string | null = null): void {
    const before = this.current;
    const tool = this.all.find((t) => t.id === id);
    if (!tool) return;
    this.gesture?.end(false);
    this.cursor.hide();
    if (before !== tool) before.leave?.(this.e);
    const kept = this.e.store.getState().choice;
    const named = (c: string | null) => tool.choices?.find((x) => x.id === c)?.id;
    this.e.set({ tool: id, choice: named(choice) ?? named(kept) ?? tool.choices?.[0]?.id ?? null });
    this.canvas.style.cursor = tool.cursor ?? "";
    // On narrow windows the whole sheet would lie over the floor that the tool is for.
    if (tool.cursor && this.e.store.getState().sheet === "full") this.e.set({ sheet: "half" });
    if (before !== tool) tool.enter?.(this.e);
  }

  /** The pointer of an event, in the viewport's pixels. */
  pointer(event: PointerEvent): ToolPointer {
    const box = this.canvas.getBoundingClientRect();
    const x = event.clientX - box.left;
    const y = event.clientY - box.top;
    return { event, x, y, level: (height) => this.e.stage.levelPoint(x, y, height) };
  }

  /** A key that no gesture used: the cross of the floor's, or the tool's own. @returns whether it was used. */
  keydown(ev: KeyboardEvent): boolean {
    return this.cursor.keydown(ev) || (this.current.keydown?.(this.e, ev) ?? false);
  }

  /** Ends the gesture that runs, as by letting its pointer go. */
  letGo(p: ToolPointer): void {
    const running = this.gesture;
    if (!running) return;
    // Over already: what `up` does, such as taking another tool up, gives nothing up.
    this.gesture = null;
    running.end(running.gesture.up?.(p) ?? true);
  }

  private down(ev: PointerEvent): void {
    this.cursor.hide();
    if (this.e.store.getState().menu !== null) this.e.setMenu(null);
    if (ev.button !== 0) return;
    if (this.gesture) {
      // A second finger is the camera's: the first one's drag is given up.
      this.gesture.end(false);
      return;
    }
    const gesture = this.current.down?.(this.e, this.pointer(ev)) ?? null;
    if (gesture) this.run(gesture, ev);
  }

  /**
   * Runs a gesture until its pointer is let go; one at a time. Markers and timeline lanes start theirs here too.
   *
   * @param start what began it; null for keys, which end it by `letGo`.
   */
  run(gesture: Gesture, start: PointerEvent | null): void {
    if (this.gesture) return;
    const { e } = this;
    const mine = (ev: PointerEvent) => ev.pointerId === start?.pointerId;
    const stop = new AbortController();
    const on = <K extends keyof WindowEventMap>(name: K, f: (ev: WindowEventMap[K]) => void) =>
      window.addEventListener(name, f, { capture: true, signal: stop.signal });
    const end = (commit: boolean): void => {
      stop.abort();
      this.gesture = null;
      this.cursor.ended();
      e.stage.setOrbit(true);
      if (!gesture.plain) e.scene.endGesture(commit);
      if (!commit) gesture.cancel?.();
      e.markers.draw();
      e.redraw();
    };
    this.gesture = { gesture, end };
    e.stage.setOrbit(false);
    if (!gesture.plain) e.scene.beginGesture();
    on("pointermove", (ev) => {
      if (mine(ev)) gesture.move(this.pointer(ev));
    });
    on("pointerup", (ev) => {
      if (mine(ev)) this.letGo(this.pointer(ev));
    });
    on("pointercancel", (ev) => {
      if (mine(ev)) end(false);
    });
    on("keydown", (ev) => {
      const used = ev.key === "Escape" || (gesture.key?.(ev) ?? false);
      if (!used) return;
      ev.preventDefault();
      ev.stopPropagation();
      if (ev.key === "Escape") end(false);
    });
    // The window's own: a button that loses the focus ends nothing.
    on("blur", (ev) => {
      if (ev.target === window) end(false);
    });
  }
}
