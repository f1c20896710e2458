/** The furniture of a scene, and the boxes that its tasks lift: objects are kept while their shape stays, and only moved. */
import { Group, type Object3D, type Raycaster } from "three";
import type { BoxTrack } from "../core/motion/types.ts";
import type { Scene, SceneProp } from "../core/scene/types.ts";
import { boxMesh, createProp, disposeProp, propShape } from "./props.ts";

/** A box of furniture this near to where a task lifts one is that task's, metres. */
const LIFTED_WITHIN = 0.35;
/** Size of a box that a task lifts, metres. */
const BOX = [0.36, 0.26, 0.28] as const;

export class Furniture {
  readonly group = new Group();
  private readonly props = new Map<string, { shape: string; object: Object3D }>();
  private readonly boxes = new Map<string, Object3D>();

  set(scene: Scene): void {
    const lifted = scene.tasks.filter((t) => t.category === "lift");
    const gone = new Set(this.props.keys());
    for (const p of scene.props) {
      // A box that a task lifts is drawn with the motion.
      if (p.kind === "box" && lifted.some((t) => near(t.position, p.position))) continue;
      gone.delete(p.id);
      const object = this.propOf(p);
      object.position.set(...p.position);
      object.rotation.y = p.yaw;
    }
    for (const id of gone) this.remove(id);
    for (const [id, o] of this.boxes) {
      if (lifted.some((t) => t.id === id)) continue;
      this.group.remove(o);
      disposeProp(o);
      this.boxes.delete(id);
    }
    for (const t of lifted) {
      let o = this.boxes.get(t.id);
      if (!o) {
        o = boxMesh(BOX);
        this.boxes.set(t.id, o);
        this.group.add(o);
      }
      o.position.set(...t.position);
      o.rotation.set(0, t.yaw, 0);
    }
  }

  private propOf(p: SceneProp): Object3D {
    const shape = propShape(p);
    const kept = this.props.get(p.id);
    if (kept?.shape === shape) return kept.object;
    if (kept) this.remove(p.id);
    const object = createProp(p);
    object.userData.id = p.id;
    this.props.set(p.id, { shape, object });
    this.group.add(object);
    return object;
  }

  private remove(id: string): void {
    const kept = this.props.get(id);
    if (!kept) return;
    this.group.remove(kept.object);
    disposeProp(kept.object);
    this.props.delete(id);
  }

  /** Boxes where the motion has them at a frame; those not carried then stay at the nearer end of their way. */
  setBoxes(tracks: readonly BoxTrack[], frame: number): void {
    for (const t of tracks) {
      const o = this.boxes.get(t.lift);
      if (!o || frame < t.first) continue;
      const k = Math.min(t.frames - 1, frame - t.first);
      const m = t.transforms;
      o.position.set(m[7 * k], m[7 * k + 1], m[7 * k + 2]);
      o.quaternion.set(m[7 * k + 3], m[7 * k + 4], m[7 * k + 5], m[7 * k + 6]);
    }
  }

  /** Id of the furniture that a ray meets first; null for none. */
  on(ray: Raycaster): string | null {
    const objects = [...this.props.values()].map((p) => p.object);
    let o: Object3D | null = ray.intersectObjects(objects, true)[0]?.object ?? null;
    while (o && typeof o.userData.id !== "string") o = o.parent;
    return o ? (o.userData.id as string) : null;
  }

  dispose(): void {
    for (const id of [...this.props.keys()]) this.remove(id);
    for (const o of this.boxes.values()) disposeProp(o);
    this.boxes.clear();
  }
}

function near(a: readonly [number, number, number], b: readonly [number, number, number]): boolean {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < LIFTED_WITHIN;
}
