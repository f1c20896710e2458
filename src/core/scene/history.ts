/** Undo and redo: whole scenes are kept (they share what did not change), one entry a gesture. */
import type { Scene } from "./types.ts";

const MOST = 500;

export class History {
  private past: Scene[] = [];
  private future: Scene[] = [];
  /** Scene at the start of a gesture under way. */
  private mark: Scene | null = null;

  constructor(private present: Scene) {}

  get scene(): Scene {
    return this.present;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Begins a gesture: what is applied until `commit` is one entry. */
  begin(): void {
    this.mark = this.present;
  }

  /** A new scene; an entry of its own unless a gesture is under way. */
  apply(scene: Scene): void {
    if (scene === this.present) return;
    if (this.mark === null) this.push(this.present);
    this.present = scene;
  }

  /** Ends a gesture. @returns whether it changed anything. */
  commit(): boolean {
    const from = this.mark;
    this.mark = null;
    if (from === null || from === this.present) return false;
    if (JSON.stringify(from) === JSON.stringify(this.present)) {
      // A drag there and back is no entry.
      this.present = from;
      return false;
    }
    this.push(from);
    return true;
  }

  /** Gives a gesture up: the scene is as it was at its start. */
  cancel(): void {
    if (this.mark !== null) this.present = this.mark;
    this.mark = null;
  }

  undo(): boolean {
    this.cancel();
    const before = this.past.pop();
    if (!before) return false;
    this.future.push(this.present);
    this.present = before;
    return true;
  }

  redo(): boolean {
    this.cancel();
    const after = this.future.pop();
    if (!after) return false;
    this.past.push(this.present);
    this.present = after;
    return true;
  }

  private push(scene: Scene): void {
    this.past.push(scene);
    if (this.past.length > MOST) this.past.shift();
    this.future = [];
  }
}
