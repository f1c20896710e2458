import { describe, expect, it } from "vitest";
import { wrapAngle } from "../../src/core/math/angle.ts";
import { midPose } from "../../src/core/math/frame2.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import type { Plan } from "../../src/core/tasks/plan-types.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";

const skeleton = createSkeleton(1.75);
const library = retargetLibrary(studio().library, skeleton);

/** Writing places along a board at z = 0; the character's left is +X. */
function along(places: { x: number; effort?: 0 | 1 }[]) {
  return parseScene({
    version: 1,
    start: { position: [places[0].x, -1.5], yaw: 0 },
    tasks: places.map(({ x, effort = 1 }, i) => ({
      id: `t${i}`,
      category: "write",
      effort,
      position: [x, 1.35, 0],
      yaw: 0,
    })),
  });
}

/** Where the feet stand once a task's steps are done. */
function stanceAt(plan: Plan, task: number) {
  const feet = { left: plan.start[0], right: plan.start[1] };
  for (const s of plan.steps) if (s.task <= task) feet[s.foot] = s;
  return midPose(feet.left, feet.right);
}

describe("from one writing place to another [TaskLoco Figure 4]", () => {
  const kindAt = (d: number): 0 | 1 | 2 => {
    const steps = planScene(along([{ x: 0 }, { x: d }]), library, skeleton).steps.filter((s) => s.task === 1);
    if (steps.every((s) => s.category === "SideStep")) return 0;
    return steps.some((s) => s.phase === "exit") && steps.some((s) => s.category === "Walk") ? 2 : 1;
  };

  it("near ones are stepped to sideways, middle ones by a partial turn, far ones by turning and walking", () => {
    const kinds = [0.3, 0.5, 0.7, 1, 1.7, 2.2, 3].map(kindAt);
    expect(kinds.slice(0, 3)).toEqual([0, 0, 0]);
    expect(kinds[3]).toBe(1);
    expect(kinds.slice(4)).toEqual([2, 2, 2]);
  });

  it("a full turn begins with a pivot on the heel", () => {
    for (const d of [2.5, -2.5]) {
      const [first] = planScene(along([{ x: 0 }, { x: d }]), library, skeleton).steps.filter(
        (s) => s.task === 1,
      );
      expect(first.category).toBe("HeelPivot");
      expect(first.phase).toBe("exit");
    }
  });
});

describe("a quick tap before longer writing [TaskLoco Figure 15]", () => {
  it("on the way is done in passing: half turned, sooner, with fewer steps", () => {
    for (const side of [1, -1]) {
      const plan = (effort: 0 | 1) =>
        planScene(along([{ x: 1.7 * side }, { x: 0, effort }, { x: -1.9 * side }]), library, skeleton);
      const tap = plan(0);
      const write = plan(1);
      const way = -90 * side * (Math.PI / 180);
      const facing = (p: Plan) => wrapAngle(stanceAt(p, 1).yaw);
      // Facing between the board and the way onwards; for longer writing the board alone.
      expect(facing(tap) * Math.sign(way)).toBeGreaterThan((25 * Math.PI) / 180);
      expect(Math.abs(facing(write))).toBeLessThan((20 * Math.PI) / 180);
      const steps = (p: Plan) => p.steps.filter((s) => s.task === 1).length;
      expect(steps(tap)).toBeLessThan(steps(write));
      const time = (p: Plan) => p.tasks[2].contact - p.tasks[0].end;
      expect(time(tap)).toBeLessThan(time(write));
    }
  });

  it("off the way is leaned to after a small side step, and left the other way", () => {
    for (const side of [1, -1]) {
      const scene = (effort: 0 | 1) => along([{ x: -0.8 * side }, { x: 0, effort }, { x: -2.3 * side }]);
      const tapScene = scene(0);
      const tap = planScene(tapScene, library, skeleton);
      const write = planScene(scene(1), library, skeleton);
      const entry = tap.steps.filter((s) => s.task === 1);
      expect(entry.map((s) => s.category)).toEqual(["SideStep", "SideStep"]);
      // It stops short of where it would stand to write, on the side it goes on to.
      expect((stanceAt(write, 1).x - stanceAt(tap, 1).x) * side).toBeGreaterThan(0.15);
      // The trunk leans the rest of the way, and the hand is there.
      const places = new Float64Array(3 * JOINT_COUNT);
      const world = new Float64Array(4 * JOINT_COUNT);
      const lean = (plan: Plan, of: Scene): number => {
        const clip = synthesiseClip(beginSynthesis(library, skeleton, plan, goalsOf(of), new Map()), "x");
        const f = Math.round(plan.tasks[1].contact * 60);
        forwardKinematics(places, world, skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
        return side * (places[3 * J.neck] - (places[3 * J.leftFoot] + places[3 * J.rightFoot]) / 2);
      };
      const upright = lean(write, scene(1));
      const leaned = lean(tap, tapScene);
      expect(leaned).toBeGreaterThan(0.05);
      expect(leaned).toBeGreaterThan(upright + 0.02);
      const hand = places[3 * J.rightHand];
      expect(Math.abs(hand)).toBeLessThan(0.15);
    }
  });
});
