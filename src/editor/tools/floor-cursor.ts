/**
 * The pointer of those who use keys alone: with a tool for the floor at hand, arrows move a cross over it, Enter presses it down,
 * arrows then drag, and Enter lets go.
 */
import type { Editor } from "../editor.ts";
import { ARROWS } from "../keys.ts";
import type { Gesture, ToolPointer } from "./tool.ts";

/** Metres that an arrow moves the cross: as much as things are nudged. */
const stepOf = (ev: KeyboardEvent): number => (ev.altKey ? 0.01 : ev.shiftKey ? 0.25 : 0.05);

export class FloorCursor {
  /** Where the cross is, x and z; null while it is not shown. */
  place: [number, number] | null = null;
  private pressed: Gesture | null = null;
  /** Whether it moved since it was let go: Enter where it just was is the tool's own key. */
  private moved = false;

  constructor(private readonly e: Editor) {}

  /** Takes the cross away: another tool is at hand, or a pointer is used. */
  hide(): void {
    this.pressed = null;
    if (!this.place) return;
    this.place = null;
    this.moved = false;
    this.e.markers.draw();
  }

  /** A key of the page, before the tool's own. @returns whether it was used. */
  keydown(ev: KeyboardEvent): boolean {
    const { e } = this;
    const tool = e.tools.current;
    // Arrows belong to the cross where floor is worked on, and to nothing else that has the focus.
    const target = ev.target as HTMLElement;
    const free = target === document.body || target.closest("#stage, .rail") !== null;
    if (!tool.down || tool.cursor !== "crosshair" || !free || ev.ctrlKey || ev.metaKey) return false;
    const way = ARROWS[ev.key];
    if (way) {
      const from = this.place ?? this.middle();
      if (!from) return false;
      const step = stepOf(ev);
      // Whole centimetres, or sums of steps would not be.
      this.place = [0, 1].map((k) => Math.round(100 * (from[k] + way[k] * step)) / 100) as [number, number];
      this.moved = true;
      this.pressed?.move(this.pointer(this.place));
      e.markers.draw();
      e.announce(`${this.place.map((v) => v.toFixed(2)).join(", ")} metres`);
      return true;
    }
    if (ev.key !== "Enter" || !this.place || !(this.moved || this.pressed)) return false;
    this.moved = false;
    if (this.pressed) {
      this.pressed = null;
      e.tools.letGo(this.pointer(this.place));
      return true;
    }
    this.pressed = tool.down(e, this.pointer(this.place));
    if (this.pressed) {
      e.tools.run(this.pressed, null);
      e.announce("Pressed. Arrows drag, Enter lets go, Escape gives up.");
    }
    return true;
  }

  /** The gesture is over, however it ended. */
  ended(): void {
    this.pressed = null;
  }

  /** The floor in the middle of what is seen. */
  private middle(): [number, number] | null {
    const { left, top, right, bottom } = this.e.stage.freeRoom;
    const at = this.e.stage.levelPoint((left + right) / 2, (top + bottom) / 2, 0);
    return at ? this.e.snapped(at) : null;
  }

  private pointer(at: [number, number]): ToolPointer {
    const { x, y } = this.e.stage.project(at[0], 0, at[1]);
    // Places are as fine as the arrows were: snapping is for hands.
    const event = new PointerEvent("pointermove", { shiftKey: true });
    return { event, x, y, level: () => [at[0], at[1]] };
  }
}
