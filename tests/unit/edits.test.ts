import { describe, expect, it } from "vitest";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import type { FootstepEdit, Scene } from "../../src/core/scene/types.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { editsOfBegun, nameOfStep, stepOfEdit } from "../../src/core/tasks/edits.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import type { Plan } from "../../src/core/tasks/plan-types.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";

const skeleton = createSkeleton(1.75);
const fitted = retargetLibrary(studio().library, skeleton);
const plain = planScene(defaultScene(), fitted, skeleton);

const none: FootstepEdit = {
  task: null,
  step: 0,
  foot: null,
  position: null,
  yaw: null,
  lift: null,
  land: null,
  rest: null,
  pinned: false,
  plant: "auto",
};
/** The default scene with one footstep of its plan edited. */
const edited = (index: number, change: Partial<FootstepEdit>): Scene => ({
  ...defaultScene(),
  edits: [{ ...none, ...nameOfStep(plain, index), ...change }],
});
const walks = plain.steps.flatMap((s, i) => (s.category === "Walk" && s.phase === "locomotion" ? [i] : []));
const middle = walks[Math.floor(walks.length / 2)];

function quality(scene: Scene, plan: Plan) {
  const goals = goalsOf(scene);
  const synthesis = beginSynthesis(fitted, skeleton, plan, goals, new Map());
  const clip = synthesiseClip(synthesis, "x");
  const chunk = wholeChunk(clip, synthesis.track.contacts);
  return measureMotion(skeleton, [chunk], clip.frames, plan, goals);
}

describe("edits of planned footsteps", () => {
  it("names every step of a plan by its task and count, and finds it again", () => {
    const ids = plain.tasks.map((t) => t.id);
    plain.steps.forEach((_, i) => {
      expect(stepOfEdit({ ...none, ...nameOfStep(plain, i) }, plain.steps, ids)).toBe(i);
    });
  });

  it("moved and turned: the footstep is where it was put, its neighbours answer, the rest stays, the motion follows", () => {
    const s = plain.steps[middle];
    const to: [number, number, number] = [
      s.x + 0.18 * Math.cos(s.yaw) * (s.foot === "left" ? 1 : -1),
      0,
      s.z - 0.18 * Math.sin(s.yaw) * (s.foot === "left" ? 1 : -1),
    ];
    const scene = edited(middle, { position: to, yaw: s.yaw + 0.2 });
    const plan = planScene(scene, fitted, skeleton);
    expect(plan.warnings).toEqual([]);
    expect(plan.steps).toHaveLength(plain.steps.length);
    expect(plan.steps[middle].x).toBeCloseTo(to[0], 9);
    expect(plan.steps[middle].z).toBeCloseTo(to[2], 9);
    expect(plan.steps[middle].yaw).toBeCloseTo(s.yaw + 0.2, 9);
    const change = plan.steps.map((p, i) => Math.hypot(p.x - plain.steps[i].x, p.z - plain.steps[i].z));
    expect(change[middle - 1] + change[middle + 1]).toBeGreaterThan(0.005);
    change.forEach((d, i) => {
      // A pivot stays on the end it turns about, wherever its footstep went.
      if (Math.abs(i - middle) > 2 && !/Pivot/.test(plan.steps[i].category)) expect(d).toBeLessThan(0.02);
    });
    const q = quality(scene, plan);
    expect(q.footstepError?.position).toBeLessThan(1);
    expect(q.footstepError?.yaw).toBeLessThan(0.5);
    expect(q.skate).toBeLessThan(4);
    expect(q.limitViolations).toBe(0);
  });

  it("stretched: the foot is in the air as long as asked, everything after it moves along", () => {
    const s = plain.steps[middle];
    const scene = edited(middle, { lift: s.lift, land: s.lift + 1.4 * (s.land - s.lift) });
    const plan = planScene(scene, fitted, skeleton);
    const now = plan.steps[middle];
    expect(now.land - now.lift).toBeCloseTo(1.4 * (s.land - s.lift), 1);
    const by = plan.duration - plain.duration;
    expect(by).toBeGreaterThan(0.1);
    const last = plan.steps.length - 1;
    expect(plan.steps[last].land - plain.steps[last].land).toBeCloseTo(by, 9);
    expect(plan.tasks[3].end - plain.tasks[3].end).toBeCloseTo(by, 9);
    expect(plan.tasks[0].end).toBe(plain.tasks[0].end);
    for (let i = 1; i < plan.segments.length; i++)
      expect(plan.segments[i].start).toBe(plan.segments[i - 1].start + plan.segments[i - 1].frames);
    const q = quality(scene, plan);
    expect(q.footstepError?.position).toBeLessThan(1);
    expect(q.skate).toBeLessThan(4);
  });

  it("plants: enforced ones hold heel and toe from landing to lift, never ones claim nothing; the rest is as it was", () => {
    const bits = (plan: Plan) => {
      const s = beginSynthesis(fitted, skeleton, plan, [], new Map());
      synthesiseClip(s, "x");
      return s.track;
    };
    const base = bits(plain);
    const step = plain.steps[middle];
    const side = step.foot === "left" ? 0 : 1;
    const from = Math.round(step.land * 60) + 1;
    const next = plain.steps.findIndex((s, i) => i > middle && s.foot === step.foot);
    const until = Math.round(plain.steps[next].lift * 60) - 1;
    const of = (track: typeof base, f: number) => (track.contacts[f] >> (2 * side)) & 3;
    // A walked plant rolls: at its ends only one of the two rests.
    expect([...base.contacts.slice(from, until)].some((_, k) => of(base, from + k) !== 3)).toBe(true);
    for (const plant of ["enforce", "never"] as const) {
      const scene = edited(middle, { plant });
      const plan = planScene(scene, fitted, skeleton);
      expect(plan.steps[middle].plant).toBe(plant);
      const track = bits(plan);
      // A heel that strikes takes a moment to come down.
      for (let f = plant === "never" ? from : from + 3; f < until; f++)
        expect(of(track, f), `${plant} at ${f}`).toBe(plant === "never" ? 0 : 3);
      for (let f = 0; f < base.frames; f++) {
        const other = (t: typeof base) => (t.contacts[f] >> (2 - 2 * side)) & 3;
        expect(other(track), `the other foot at ${f}`).toBe(other(base));
        if (f < Math.round(step.lift * 60) || f > Math.round(plain.steps[next].land * 60) + 12)
          expect(of(track, f), `the foot at ${f}`).toBe(of(base, f));
      }
      const q = quality(scene, plan);
      expect(q.skate).toBeLessThan(4);
      expect(q.penetration).toBeLessThan(3);
      expect(q.limitViolations).toBe(0);
      expect(q.poppingOwn).toBeLessThan(1.75);
      // What is not claimed though the foot rests is counted.
      expect(q.missedPlants).toBe(plant === "never" ? 2 : 0);
    }
  });

  it("rests: a plant lasts as long as asked, the step of the other foot takes the time, everything after moves along", () => {
    const step = plain.steps[middle];
    const lifts = (p: Plan) =>
      p.steps.find((s, i) => i > middle && s.foot === step.foot)!.lift - p.steps[middle].land;
    for (const factor of [1.5, 0.8]) {
      const wanted = factor * lifts(plain);
      const scene = edited(middle, { rest: wanted });
      const plan = planScene(scene, fitted, skeleton);
      expect(plan.warnings).toEqual([]);
      expect(lifts(plan)).toBeCloseTo(wanted, 1);
      expect(plan.steps[middle].land).toBe(step.land);
      expect(plan.duration - plain.duration).toBeCloseTo(wanted - lifts(plain), 1);
      for (let i = 1; i < plan.segments.length; i++)
        expect(plan.segments[i].start).toBe(plan.segments[i - 1].start + plan.segments[i - 1].frames);
      const q = quality(scene, plan);
      expect(q.skate).toBeLessThan(4);
      expect(q.limitViolations).toBe(0);
    }
  });

  it("out of reach: drawn in, and said in one sentence with both lengths", () => {
    const s = plain.steps[middle];
    const stance = plain.steps[middle - 1];
    const far: Partial<FootstepEdit> = {
      position: [s.x + 1.3 * Math.cos(s.yaw), 0, s.z - 1.3 * Math.sin(s.yaw)],
      pinned: true,
    };
    const scene = edited(middle, far);
    // With the foot that it steps from pinned as well, no neighbour can come to meet it.
    scene.edits.push({
      ...none,
      ...nameOfStep(plain, middle - 1),
      position: [stance.x, 0, stance.z],
      pinned: true,
    });
    const plan = planScene(scene, fitted, skeleton);
    expect(plan.warnings.join(" ")).toMatch(
      /edits\[0\]: too far to reach in one step: 1\.\d\d m, 0\.\d\d m at most\./,
    );
    for (let i = 1; i < plan.steps.length; i++) expect(Number.isFinite(plan.steps[i].x)).toBe(true);
  });

  it("lost: an edit whose footstep has gone elsewhere waits and says so; pinned ones hold on longer", () => {
    const s = plain.steps[middle];
    const away: [number, number, number] = [s.x + 1.1, 0, s.z];
    const loose = planScene(edited(middle, { position: away }), fitted, skeleton);
    expect(loose.warnings.join(" ")).toContain("the edit waits");
    expect(loose.steps[middle].x).toBeCloseTo(s.x, 9);
    expect(planScene(edited(0, { task: "sit", step: 999 }), fitted, skeleton).warnings.join(" ")).toContain(
      "no such footstep",
    );
  });

  it("swapped: the other foot takes the step, and the walk goes on from it to the same tasks", () => {
    const first = walks.find((i) => plain.steps[i].task === 1) ?? walks[0];
    const foot = plain.steps[first].foot === "left" ? "right" : "left";
    const scene = edited(first, { foot });
    const plan = planScene(scene, fitted, skeleton);
    expect(plan.steps[first].foot).toBe(foot);
    expect(plan.tasks.map((t) => t.id)).toEqual(["write", "lift", "place", "sit"]);
    const q = quality(scene, plan);
    expect(q.footstepError?.position).toBeLessThan(1);
    expect(q.skate).toBeLessThan(4);
  });

  it("while it plays: steps begun are kept unless their own edits changed", () => {
    const s = plain.steps[middle];
    const scene = edited(middle, { position: [s.x + 0.1, 0, s.z] });
    expect(editsOfBegun(plain, [], scene.edits, s.land + 1)).toBe(true);
    expect(editsOfBegun(plain, [], scene.edits, plain.steps[middle - 4].lift)).toBe(false);
    const now = plain.steps[middle - 4].lift;
    const again = planScene(scene, fitted, skeleton, {
      playing: { plan: plain, now, goals: goalsOf(defaultScene()) },
    });
    expect(again.steps[middle].x).toBeCloseTo(s.x + 0.1, 9);
    expect(again.steps[middle - 5].x).toBe(plain.steps[middle - 5].x);
  });
});
