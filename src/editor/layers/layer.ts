/** Something that a feature draws in the stage: told when the scene, the plan, the time or the theme change. */
import type { Object3D, Raycaster } from "three";
import type { Theme } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import type { Ref } from "../selection.ts";

/** What changed: the scene document, the plan, what is selected, or how things are shown. */
export type Change = "scene" | "plan" | "selection" | "look";

export interface ViewportLayer {
  id: string;
  /** Added to the stage; leave out for layers that draw through the stage's own methods. */
  object?: Object3D;
  /** Something changed. */
  update?(e: Editor, what: Change): void;
  /** What is shown at a time, seconds. Called each frame while playing: no allocation. */
  time?(e: Editor, seconds: number): void;
  theme?(theme: Theme): void;
  /** Where bodies stand that are to be seen whole instead of the scene's things, metres; null when it shows none of its own. */
  frames?(): readonly (readonly [number, number, number])[] | null;
  /** What of it is under the pointer. */
  pick?(ray: Raycaster): Ref | null;
  dispose?(): void;
}

export class LayerHost {
  private layers: ViewportLayer[] = [];
  private alone: string | null = null;

  constructor(private readonly e: Editor) {}

  add(layer: ViewportLayer): void {
    this.layers.push(layer);
    if (layer.object) this.e.stage.add(layer.object);
    layer.theme?.(this.e.store.getState().theme);
    layer.update?.(this.e, "scene");
    layer.time?.(this.e, this.e.store.getState().time);
  }

  remove(layer: ViewportLayer): void {
    this.layers = this.layers.filter((x) => x !== layer);
    if (layer.object) this.e.stage.remove(layer.object);
    layer.dispose?.();
  }

  /** Shows one layer alone: the others are hidden, and told nothing but the theme, until null. */
  only(id: string | null): void {
    this.alone = id;
    for (const l of this.layers) if (l.object) l.object.visible = id === null || l.id === id;
  }

  private get told(): readonly ViewportLayer[] {
    return this.alone === null ? this.layers : this.layers.filter((l) => l.id === this.alone);
  }

  update(what: Change): void {
    for (const l of this.told) l.update?.(this.e, what);
    this.e.stage.invalidate();
  }

  time(seconds: number): void {
    for (const l of this.told) l.time?.(this.e, seconds);
    this.e.stage.invalidate();
  }

  theme(theme: Theme): void {
    for (const l of this.layers) l.theme?.(theme);
  }

  /** What a layer wants framed instead of the scene; null when none does. */
  frames(): readonly (readonly [number, number, number])[] | null {
    for (const l of this.told) {
      const points = l.frames?.();
      if (points) return points;
    }
    return null;
  }

  /** The topmost layer's answer to what is under a point of the viewport. */
  pick(x: number, y: number): Ref | null {
    const ray = this.e.stage.ray(x, y);
    for (let i = this.layers.length - 1; i >= 0; i--) {
      const hit = this.layers[i].pick?.(ray);
      if (hit) return hit;
    }
    return null;
  }
}
