/** One motion after another: a scene's tasks or paths, then its stones, from where the character stands. */
import type { Clip } from "../capture/clip.ts";
import { CLIP_RATE } from "../capture/clip.ts";
import type { Scene, SceneTask } from "../scene/types.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { Footstep } from "../steps/types.ts";
import { orderedTasks } from "../tasks/plan-scene.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { Standing } from "./plan-stones.ts";

/** A plan with its motion. */
export interface PlannedMotion {
  plan: Plan;
  clip: Clip;
  contacts: Uint8Array;
}

/** Where a motion leaves the character: its last footsteps and its last frame. */
export function standingAfter({ plan, clip }: PlannedMotion): Standing {
  const last = (foot: "left" | "right"): Footstep => {
    const s = plan.steps.findLast((p) => p.foot === foot) ?? plan.start[foot === "left" ? 0 : 1];
    return { foot, x: s.x, y: s.y, z: s.z, yaw: s.yaw };
  };
  const f = clip.frames - 1;
  const q = 4 * JOINT_COUNT;
  return {
    feet: [last("left"), last("right")],
    root: clip.root.slice(3 * f, 3 * f + 3),
    rotations: clip.rotations.slice(q * f, q * f + q),
  };
}

/** The second motion, which began where the first ends, after it. */
export function joinMotions(a: PlannedMotion, b: PlannedMotion): PlannedMotion {
  const later = a.clip.frames / CLIP_RATE;
  const joined = <T extends Float64Array | Uint8Array>(out: T, x: T, y: T): T => {
    out.set(x);
    out.set(y, x.length);
    return out;
  };
  return {
    plan: {
      ...a.plan,
      steps: [
        ...a.plan.steps,
        ...b.plan.steps.map((s) => ({ ...s, lift: s.lift + later, land: s.land + later })),
      ],
      duration: later + b.plan.duration,
      warnings: [...a.plan.warnings, ...b.plan.warnings],
    },
    clip: {
      ...a.clip,
      frames: a.clip.frames + b.clip.frames,
      root: joined(new Float64Array(a.clip.root.length + b.clip.root.length), a.clip.root, b.clip.root),
      rotations: joined(
        new Float64Array(a.clip.rotations.length + b.clip.rotations.length),
        a.clip.rotations,
        b.clip.rotations,
      ),
    },
    contacts: joined(
      new Uint8Array(a.contacts.length + b.contacts.length),
      a.contacts as Uint8Array<ArrayBuffer>,
      b.contacts as Uint8Array<ArrayBuffer>,
    ),
  };
}

/** A scene whose last task before its stones is sitting, with a rise after it: nobody steps from a seat. */
export function risen(scene: Scene): Scene {
  const last = orderedTasks(scene).at(-1);
  if (scene.stones.length === 0 || last?.category !== "sit") return scene;
  const rise: SceneTask = { ...last, id: `${last.id}/rise`, category: "stand", duration: null };
  const at = scene.order.indexOf(last.id) + 1;
  return {
    ...scene,
    tasks: [...scene.tasks, rise],
    order: [...scene.order.slice(0, at), rise.id, ...scene.order.slice(at)],
  };
}
