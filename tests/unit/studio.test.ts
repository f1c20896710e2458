import { describe, expect, it } from "vitest";
import type { Clip } from "../../src/core/capture/clip.ts";
import { solePoints } from "../../src/core/contacts/baselines.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { pivotPlace, plantedAnkle } from "../../src/core/motion/sole.ts";
import { createRangeWorkspace, jointsOutOfRange } from "../../src/core/quality/joint-ranges.ts";
import { paceOf } from "../../src/core/quality/kind.ts";
import { motionPoints, steadyJerk } from "../../src/core/quality/measure.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { type ContactTrack, STEP_CATEGORIES, type StepCategory } from "../../src/core/steps/types.ts";
import { renderScore } from "../../src/studio/render.ts";
import { CATEGORY_OF, type StepKind } from "../../src/studio/score.ts";
import { everyScore } from "../../src/studio/set.ts";
import { studio } from "../support/library.ts";

describe("planted foot", () => {
  const shape = createSkeleton(1.75).foot;
  const out = new Float64Array(3);
  it("rolls over a heel point that stays", () => {
    for (const pitch of [0, 0.1, 0.3, 0.5]) {
      plantedAnkle(out, shape, pitch);
      const back = out[0] - shape.heelBack * Math.cos(pitch) + shape.ankleHeight * Math.sin(pitch);
      const up = out[1] - shape.heelBack * Math.sin(pitch) - shape.ankleHeight * Math.cos(pitch);
      expect(back).toBeCloseTo(-shape.heelBack, 10);
      expect(up).toBeCloseTo(0, 10);
    }
  });
  it("rolls over a ball that stays until the toes rise, then over the tip", () => {
    const ball = (pitch: number) => {
      plantedAnkle(out, shape, pitch);
      const rise = shape.ankleHeight - shape.ballHeight;
      return [
        out[0] + shape.ballForward * Math.cos(pitch) + rise * Math.sin(pitch),
        out[1] + shape.ballForward * Math.sin(pitch) - rise * Math.cos(pitch),
      ];
    };
    for (const pitch of [-0.05, -0.2]) {
      expect(ball(pitch)[0]).toBeCloseTo(shape.ballForward, 3);
      expect(ball(pitch)[1]).toBeCloseTo(shape.ballHeight, 3);
    }
    expect(ball(-1)[1]).toBeGreaterThan(shape.ballHeight + 0.01);
  });
  it("pivots about a point that stays", () => {
    const from = { x: 0.3, z: -0.2, yaw: 0.4 };
    for (const [end, d] of [
      ["heel", -shape.heelBack],
      ["ball", shape.ballForward],
    ] as const) {
      const to = pivotPlace(shape, from, 1.1, end);
      expect(to.x + d * Math.sin(to.yaw)).toBeCloseTo(from.x + d * Math.sin(from.yaw), 12);
      expect(to.z + d * Math.cos(to.yaw)).toBeCloseTo(from.z + d * Math.cos(from.yaw), 12);
    }
  });
});

describe("captures of the studio", () => {
  const { rendered } = studio();
  it("claimed plants slide under 1 mm and never sink by 3 mm", () => {
    for (const r of rendered) {
      const points = solePoints(r.clip);
      for (let side = 0; side < 2; side++) {
        let x = 0;
        let z = 0;
        let on = false;
        for (let f = 1; f < r.clip.frames; f++) {
          const o = (2 * f + side) * 9;
          const flat = ((r.contacts[f] >> (2 * side)) & 3) === 3;
          if (flat && on) {
            x += points[o + 3] - points[o - 18 + 3];
            z += points[o + 5] - points[o - 18 + 5];
            expect(Math.hypot(x, z), `${r.name} frame ${f}`).toBeLessThan(1e-3);
          } else x = z = 0;
          on = flat;
          for (const k of [1, 4, 7]) expect(points[o + k], `${r.name} frame ${f}`).toBeGreaterThan(-0.006);
        }
      }
    }
  });
  it("are made the same twice", async () => {
    const { studioSet } = await import("../../src/studio/set.ts");
    const { clip } = renderScore(studioSet()[2].score);
    expect(Buffer.from(clip.rotations.buffer).equals(Buffer.from(rendered[2].clip.rotations.buffer))).toBe(
      true,
    );
  });
});

describe("the whole set that ships", () => {
  it("has tasks, seven styles, some two dozen cycles and two more actors, each under its own name", async () => {
    const names = everyScore().map((s) => s.name);
    expect(new Set(names).size).toBe(names.length);
    expect(names.filter((n) => n.startsWith("style-"))).toHaveLength(7);
    expect(names.filter((n) => n.startsWith("cycle-")).length).toBeGreaterThanOrEqual(24);
    for (const who of ["short-", "tall-"]) expect(names.some((n) => n.startsWith(who))).toBe(true);
  });

  it("is rendered the same twice, worn or not; wear moves it by centimetres and no more", async () => {
    const { wearClip } = await import("../../src/studio/realism.ts");
    for (const name of ["style-jogging", "cycle-side-1", "tall-walk"]) {
      const score = everyScore().find((s) => s.name === name)?.score;
      if (!score) throw new Error(name);
      const a = renderScore(score).clip;
      const b = renderScore(score).clip;
      expect(Buffer.from(a.rotations.buffer).equals(Buffer.from(b.rotations.buffer))).toBe(true);
      const worn = wearClip(a, 5);
      expect(wearClip(b, 5).root).toEqual(worn.root);
      let most = 0;
      for (let k = 0; k < a.root.length; k++) most = Math.max(most, Math.abs(worn.root[k] - a.root[k]));
      expect(most).toBeGreaterThan(0.01);
      expect(most).toBeLessThan(0.06);
    }
  });

  /** Every capture, those of the tasks' library as they are there. */
  const every = (() => {
    let all: { name: string; clip: Clip; contacts: ContactTrack }[] | null = null;
    return () => {
      const made = new Map(studio().rendered.map((r) => [r.name, r]));
      all ??= everyScore().map(({ name, score }) => ({ ...(made.get(name) ?? renderScore(score)), name }));
      return all;
    };
  })();

  it("moves hands, feet, head and hips with real people's jerk: 0.7 to 1.4 of it in every capture's steady part", () => {
    const ratios = every().map(({ name, clip, contacts }) => {
      const { skeleton, frames } = clip;
      const points = motionPoints(skeleton, [wholeChunk(clip, contacts)], frames);
      const pace = paceOf(points.root, points.yaw, frames, 60);
      const jerk = steadyJerk(points, pace, skeleton.legLength - skeleton.foot.ankleHeight);
      expect(jerk, name).toBeGreaterThanOrEqual(0.7);
      expect(jerk, name).toBeLessThanOrEqual(1.4);
      return jerk ?? 0;
    });
    ratios.sort((a, b) => a - b);
    // Not at the border either: half of them come close to people.
    const [quarter, most] = [0.25, 0.75].map((share) => ratios[Math.floor(share * ratios.length)]);
    console.log(
      `jerk beside real ones: ${[ratios[0], quarter, most, ratios.at(-1)].map((r) => r?.toFixed(2))}`,
    );
    expect(quarter).toBeGreaterThan(0.8);
    expect(most).toBeLessThan(1.1);
  });

  it("bends no joint beyond its range in any frame", () => {
    const range = createRangeWorkspace();
    const places = new Float64Array(3 * JOINT_COUNT);
    const world = new Float64Array(4 * JOINT_COUNT);
    for (const { name, clip } of every()) {
      const { skeleton, frames, root, rotations } = clip;
      for (let f = 0; f < frames; f++) {
        forwardKinematics(places, world, skeleton, root, 3 * f, rotations, 4 * JOINT_COUNT * f);
        expect(jointsOutOfRange(places, 0, world, 0, range), `${name}, frame ${f}`).toEqual([]);
      }
    }
  });

  it("has every step category thirty times, and segmentation finds each, named right, within two frames", () => {
    const seen = new Map<StepCategory, { count: number; named: number; timed: number }>();
    for (const c of STEP_CATEGORIES) seen.set(c, { count: 0, named: 0, timed: 0 });
    let late = 0;
    let all = 0;
    const { rendered, library } = studio();
    rendered.forEach((r, i) => {
      const found = [...library.clips[i].steps];
      for (const s of r.sidecar.steps ?? []) {
        const off = (k: number) =>
          Math.max(Math.abs(found[k].start - 60 * s.lift), Math.abs(found[k].end - 60 * s.land));
        let best = -1;
        for (let k = 0; k < found.length; k++)
          if (found[k].foot === s.foot && (best < 0 || off(k) < off(best))) best = k;
        expect(best, `${r.name}: ${s.category} at ${s.lift}`).toBeGreaterThanOrEqual(0);
        expect(off(best), `${r.name}: ${s.category} at ${s.lift}`).toBeLessThan(20);
        const [step] = found.splice(best, 1);
        const inTime = Math.abs(step.start - 60 * s.lift) <= 2.01 && Math.abs(step.end - 60 * s.land) <= 2.01;
        all++;
        if (!inTime) late++;
        const wanted = CATEGORY_OF[s.category as StepKind];
        const row = wanted && seen.get(wanted);
        if (!row) continue;
        row.count++;
        if (step.category === wanted) row.named++;
        if (inTime) row.timed++;
      }
      expect(found, `${r.name}: steps that nobody took`).toEqual([]);
    });
    console.log(
      [...seen].map(([c, s]) => `${c}: ${s.count}, named right ${s.named}, in time ${s.timed}`).join("\n"),
    );
    for (const [category, s] of seen) {
      expect(s.count, category).toBeGreaterThanOrEqual(30);
      expect(s.named / s.count, category).toBeGreaterThanOrEqual(0.97);
      expect(s.timed / s.count, category).toBeGreaterThanOrEqual(0.98);
    }
    expect(late / all).toBeLessThan(0.01);
  });
});
