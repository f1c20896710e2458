/** The scene being edited: its history, what is selected, and that it is kept. */
import * as commands from "../../core/scene/commands.ts";
import { History } from "../../core/scene/history.ts";
import { parseScene } from "../../core/scene/schema.ts";
import type { Scene } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { hasRef, type Ref, sameRef } from "../selection.ts";
import { keepVersion, saveScene } from "./storage.ts";

/** Milliseconds without a change before the scene is kept. */
const SAVE_AFTER = 500;

const same = (a: Scene, b: Scene): boolean => JSON.stringify(a) === JSON.stringify(b);

export class SceneSession {
  private readonly history: History;
  /** What was called how where another scene was opened, by the scene that was opened. */
  private readonly names = new WeakMap<Scene, { before: string; after: string }>();
  private gesturing = false;
  private saveTimer = 0;

  constructor(
    private readonly e: Editor,
    scene: Scene,
  ) {
    this.history = new History(scene);
    // A hidden tab may never be shown again: what waits is kept now.
    document.addEventListener("visibilitychange", () => {
      if (document.hidden && this.saveTimer !== 0) this.save();
    });
  }

  get scene(): Scene {
    return this.history.scene;
  }

  /** Whether a drag is under way. */
  get inGesture(): boolean {
    return this.gesturing;
  }

  /** One change of the scene by a command; planned at once. What the schema refuses is not done, and said. */
  edit(change: (scene: Scene, c: typeof commands) => Scene): boolean {
    const scene = change(this.history.scene, commands);
    // What comes to the same is no entry: undo always does something.
    if (scene === this.history.scene || same(scene, this.history.scene)) return false;
    try {
      parseScene(scene);
    } catch (error) {
      this.e.fail(error instanceof Error ? error.message : String(error));
      return false;
    }
    this.history.apply(scene);
    this.changed();
    return true;
  }

  private changed(): void {
    const { scene } = this.history;
    const { selection, toast } = this.e.store.getState();
    const kept = selection.filter((r) => this.exists(scene, r));
    this.e.set({
      scene,
      // Its Undo would undo something else from now on.
      toast: toast?.undo ? null : toast,
      selection: kept.length === selection.length ? selection : kept,
      canUndo: this.history.canUndo,
      canRedo: this.history.canRedo,
      error: null,
    });
    this.e.sceneChanged();
    window.clearTimeout(this.saveTimer);
    this.e.set({ saved: "saving" });
    this.saveTimer = window.setTimeout(() => this.save(), SAVE_AFTER);
  }

  private exists(scene: Scene, r: Ref): boolean {
    const lists = [scene.tasks, scene.paths, scene.stones, scene.props];
    const named = { task: 0, path: 1, point: 1, stone: 2, prop: 3 }[r.kind];
    return named === undefined || lists[named].some((x) => x.id === r.id);
  }

  private save(): void {
    window.clearTimeout(this.saveTimer);
    this.saveTimer = 0;
    void saveScene(this.history.scene, this.e.store.getState().name).then((ok) => {
      // A newer scene that waits to be kept says so itself.
      if (this.saveTimer === 0) this.e.set({ saved: ok ? "saved" : "off" });
    });
  }

  /** What is edited until `endGesture` is one entry of the history. Called by the tool host and by sliders. */
  beginGesture(): void {
    if (this.gesturing) return;
    this.gesturing = true;
    this.history.begin();
  }

  endGesture(commit: boolean): void {
    if (!this.gesturing) return;
    this.gesturing = false;
    if (commit) this.history.commit();
    else {
      this.history.cancel();
      this.changed();
    }
    this.e.set({ canUndo: this.history.canUndo, canRedo: this.history.canRedo });
    this.e.plan.announce();
  }

  undo(): void {
    const opened = this.names.get(this.history.scene);
    if (!this.history.undo()) return;
    // The scene that comes back is called what it was called.
    if (opened) {
      opened.after = this.e.store.getState().name;
      this.e.set({ name: opened.before });
    }
    this.changed();
  }

  redo(): void {
    if (!this.history.redo()) return;
    const opened = this.names.get(this.history.scene);
    if (opened) {
      opened.before = this.e.store.getState().name;
      this.e.set({ name: opened.after });
    }
    this.changed();
  }

  /** Another scene, as one entry of the history: undo brings the one before back. `name` is what it is called. */
  replace(opened: Scene, name: string): void {
    const { name: before } = this.e.store.getState();
    // Undo brings it back while the page is open; a version does after that.
    if (this.history.canUndo) void keepVersion(`${before}, before ${name}`, this.history.scene, Date.now());
    // A document of its own: an example may be opened twice.
    const scene = { ...opened };
    this.names.set(scene, { before, after: name });
    this.history.apply(scene);
    this.e.set({ selection: [], tab: "scene", menu: null, time: 0, name });
    this.e.plan.startOver();
    this.changed();
    this.e.frameScene();
    this.e.say(`${name} opened.`, true);
  }

  /** What the scene is called from now on. */
  rename(name: string): void {
    this.e.set({ name: name.trim() === "" ? "Scene" : name.trim().slice(0, 80) });
    this.save();
  }

  // ---- the selection -------------------------------------------------------------------------------------------

  /** Selects things; `open` shows their tab of the panel. */
  select(refs: readonly Ref[], open = true): void {
    const kind = refs.length > 0 ? this.e.registry.thing(refs[refs.length - 1].kind) : undefined;
    const { tab } = this.e.store.getState();
    this.e.set({ selection: refs, tab: open && kind?.tab ? kind.tab : tab });
    this.e.layers.update("selection");
    this.e.markers.draw();
  }

  /** Adds a thing to the selection or takes it out. */
  toggle(r: Ref): void {
    const { selection } = this.e.store.getState();
    this.select(hasRef(selection, r) ? selection.filter((x) => !sameRef(x, r)) : [...selection, r]);
  }

  /** Copies of what is selected, beside it; the copies are selected then. */
  duplicate(): void {
    const { selection } = this.e.store.getState();
    const copies: Ref[] = [];
    const done = this.edit((scene) => {
      let out = scene;
      for (const kind of this.e.registry.things) {
        const mine = selection.filter((r) => r.kind === kind.kind);
        if (mine.length === 0 || !kind.duplicate) continue;
        const copied = kind.duplicate(out, mine);
        out = copied.scene;
        copies.push(...copied.refs);
      }
      return out;
    });
    if (done) this.select(copies);
  }

  /** Takes away what is selected. */
  remove(): void {
    const { selection } = this.e.store.getState();
    const nouns = new Set<string>();
    const done = this.edit((scene) => {
      let out = scene;
      for (const kind of this.e.registry.things) {
        const mine = selection.filter((r) => r.kind === kind.kind);
        if (mine.length === 0) continue;
        nouns.add(mine.length > 1 ? kind.title : kind.noun);
        out = kind.remove(out, mine);
      }
      return out;
    });
    if (!done) return;
    this.select([]);
    const what = [...nouns].join(" and ").toLowerCase();
    this.e.say(`${what.charAt(0).toUpperCase()}${what.slice(1)} deleted.`, true);
  }

  /** Moves everything selected by metres, and turns it by radians about itself. */
  nudge(dx: number, dz: number, turn: number): void {
    const { selection } = this.e.store.getState();
    const things = this.e.things().filter((t) => hasRef(selection, t.ref));
    this.edit((scene) => {
      let out = scene;
      for (const t of things) {
        const kind = this.e.registry.thing(t.ref.kind);
        const [x, y, z] = t.position;
        if (kind) out = kind.place(out, t.ref, [x + dx, y, z + dz], (t.yaw ?? 0) + turn);
      }
      return out;
    });
  }
}
