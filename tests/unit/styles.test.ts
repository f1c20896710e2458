/** Paths with style [Express]: loops from samples, blends, and walks along paths. */

import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { readScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { blendAt, FIXED_BLEND } from "../../src/core/styles/blend-length.ts";
import type { StrideFamily } from "../../src/core/styles/family.ts";
import { createFeetTrack, settleFeet } from "../../src/core/styles/feet.ts";
import { cutLoop, loopRow, StyleError } from "../../src/core/styles/loop.ts";
import { nearestOnPath, readPath } from "../../src/core/styles/path.ts";
import { type PathPlan, planPaths } from "../../src/core/styles/plan-paths.ts";
import { ROW } from "../../src/core/styles/rows.ts";
import type { PathOptions } from "../../src/core/styles/synthesise-path.ts";
import { freeName, styleFacts, styleFromBvh, styleName } from "../../src/core/styles/user-style.ts";
import { renderScore } from "../../src/studio/render.ts";
import { styleFamilies } from "../../src/studio/style-families.ts";
import { STYLES, styleScore } from "../../src/studio/styles.ts";
import { jointPopping } from "../support/joint-popping.ts";
import { randomPath } from "../support/random-path.ts";
import { captures, hasShared } from "../support/shared.ts";

const skeleton = createSkeleton(1.75);
let families: Map<string, StrideFamily>;
beforeAll(() => {
  families = styleFamilies(STYLES, skeleton);
}, 60_000);

type Painted = { at: number; style: string }[];

function sceneOf(points: number[][], styles: Painted = [], smooth = true): Scene {
  return readScene(JSON.stringify({ version: 1, paths: [{ id: "p", points, styles, smooth }] }), "test");
}

function walk(points: number[][], styles: Painted = [], smooth = true): PathPlan {
  return planPaths(sceneOf(points, styles, smooth), skeleton, families);
}

function qualityOf({ plan, motion }: PathPlan) {
  const { clip, contacts } = motion;
  const chunk = wholeChunk(clip, contacts);
  return measureMotion(skeleton, [chunk], clip.frames, plan, []);
}

const range = (n: number) => Array.from({ length: n }, (_, i) => i);
const PATHS: Record<string, { points: number[][]; smooth: boolean }> = {
  line: {
    points: [
      [0, 0],
      [0, 8],
    ],
    smooth: true,
  },
  sine: { points: range(29).map((i) => [1.2 * Math.sin((i * Math.PI) / 7), i / 2]), smooth: true },
  circle: { points: range(34).map((i) => [2 - 2 * Math.cos(i / 5), 2 * Math.sin(i / 5)]), smooth: true },
  eight: { points: range(33).map((i) => [3 * Math.sin(i / 5), 1.5 * Math.sin((2 * i) / 5)]), smooth: true },
  square: {
    points: [
      [0, 0],
      [0, 3],
      [3, 3],
      [3, 0],
      [0, 0],
    ],
    smooth: false,
  },
};

describe("walks along paths [Express §§6, 7]", () => {
  for (const [name, { points, smooth }] of Object.entries(PATHS))
    it(`${name}: feet stay put and stand on their footsteps`, () => {
      const q = qualityOf(walk(points, [], smooth));
      expect(q.skate ?? 0).toBeLessThan(1);
      expect(q.penetration ?? 0).toBeLessThan(3);
      expect(q.float ?? 0).toBeLessThan(5);
      expect(q.footstepError?.position ?? 0).toBeLessThan(1);
      expect(q.limitViolations).toBe(0);
      expect(q.missedPlants).toBe(0);
      expect(q.popping ?? 0).toBeLessThan(1.5);
      expect(q.poppingOwn ?? 0).toBeLessThan(1.75);
      expect(q.balanceWithin50mm ?? 0).toBeGreaterThan(0.69);
    });

  it("changes of style on a winding path pop no more, and claim every plant", () => {
    for (const pair of [
      ["walking", "jogging", "walking"],
      ["energetic", "tired", "excited"],
      ["distressed", "balancing", "energetic"],
    ]) {
      const styles = pair.map((style, i) => ({ at: i / 3, style }));
      const q = qualityOf(walk(PATHS.sine.points.slice(0, 20), styles));
      expect(q.poppingOwn ?? 0, pair.join()).toBeLessThan(1.75);
      expect(q.skate ?? 0, pair.join()).toBeLessThan(1);
      expect(q.missedPlants, pair.join()).toBe(0);
      expect(q.limitViolations, pair.join()).toBe(0);
    }
  });

  it("ends, whatever style is last, with both feet down at the path's end", () => {
    for (const style of STYLES) {
      const { motion, path } = walk(PATHS.line.points, [{ at: 0, style }]);
      const last = motion.clip.frames - 1;
      expect(motion.contacts[last], style).toBe(15);
      expect(motion.timeline.warnings, style).toEqual([]);
      expect(Math.abs(motion.clip.root[3 * last + 2] - 8), style).toBeLessThan(0.25);
      expect(motion.timeline.at[last], style).toBeCloseTo(path.length, 1);
    }
  });

  it("keeps the hips on the sample's own offset from the path; without it they are drawn along", () => {
    for (const name of ["sine", "circle", "eight", "square"]) {
      const { points, smooth } = PATHS[name];
      const { motion } = walk(points, [], smooth);
      expect(motion.offset, name).toBeLessThan(0.05);
    }
    const bare = { displacement: false, balance: false, stand: false };
    const { motion, path } = planPaths(sceneOf(PATHS.eight.points), skeleton, families, bare);
    const far = (c: Float64Array) => {
      let most = 0;
      for (let f = 0; f < c.length / 3; f++)
        most = Math.max(most, nearestOnPath(path, c[3 * f], c[3 * f + 2]).distance);
      return most;
    };
    expect(far(motion.clip.root)).toBeLessThan(0.002);
    const swayed = planPaths(sceneOf(PATHS.eight.points), skeleton, families, {
      ...bare,
      displacement: true,
    });
    expect(far(swayed.motion.clip.root)).toBeGreaterThan(0.015);
    expect(far(swayed.motion.clip.root)).toBeLessThan(0.08);
  });

  it("goes slower, with shorter strides, where the path curves", () => {
    const { motion, path } = walk(PATHS.eight.points);
    const { timeline } = motion;
    const line = walk(PATHS.line.points).motion.timeline;
    expect(Math.min(...line.scale)).toBeGreaterThan(0.99);
    expect(Math.min(...timeline.scale)).toBeLessThan(0.7);
    expect(Math.min(...timeline.scale)).toBeGreaterThanOrEqual(0.5);
    // Where a stride is shorter by a tenth, so is the way a frame; timing stays.
    for (let f = 100; f < timeline.frames - 100; f += 7) {
      const speed = timeline.at[f + 1] - timeline.at[f];
      expect(speed).toBeCloseTo(timeline.scale[f] * (families.get("walking")?.loop.speed ?? 0), 4);
    }
    expect(path.length).toBeGreaterThan(10);
  });

  it("leans into bends within a degree of what balances the centripetal force", () => {
    for (const name of ["sine", "eight", "circle"]) {
      const { motion, path } = walk(PATHS[name].points);
      const { at, frames } = motion.timeline;
      let most = 0;
      // Away from start and stop, which the differences over half a second see from afar.
      for (let f = 120; f < frames - 160; f++) {
        const v = (at[f + 1] - at[f - 1]) * 30;
        const wanted = Math.atan((v * v * readPath(path, path.curvature, at[f])) / 9.81);
        most = Math.max(most, Math.abs(wanted));
        expect((Math.abs(motion.lean[f] - wanted) * 180) / Math.PI, `${name}, frame ${f}`).toBeLessThan(1);
      }
      expect((most * 180) / Math.PI, name).toBeGreaterThan(2);
    }
  });

  it("has a switch for each enhancement, and each shows what it was there for", () => {
    const scene = sceneOf(PATHS.eight.points);
    const without = (options: Partial<PathOptions>) =>
      qualityOf(planPaths(scene, skeleton, families, options));
    expect(without({ feet: false }).skate ?? 0).toBeGreaterThan(20);
    expect(without({ balance: false }).balanceWithin50mm ?? 1).toBeLessThan(
      (without({}).balanceWithin50mm ?? 0) - 0.03,
    );
    const fast = planPaths(scene, skeleton, families, { stride: false }).motion.timeline;
    expect(Math.min(...fast.scale)).toBe(1);
    const upright = planPaths(scene, skeleton, families, { lean: false }).motion;
    expect(Math.max(...upright.lean)).toBe(0);
  });

  it("follows twenty random paths with random styles without NaN, sliding or popping", () => {
    for (let k = 0; k < 20; k++) {
      const { points, styles, smooth } = randomPath(k + 11);
      const plan = walk(points, styles, smooth);
      expect(plan.motion.clip.rotations.every(Number.isFinite)).toBe(true);
      const q = qualityOf(plan);
      expect(q.skate ?? 0, `path ${k}`).toBeLessThan(4);
      expect(q.penetration ?? 0, `path ${k}`).toBeLessThan(3);
      expect(q.poppingOwn ?? 0, `path ${k}`).toBeLessThan(1.75);
    }
  });

  it("names the place of a path or a style that cannot be followed", () => {
    const style = [{ at: 0, style: "moonwalk" }];
    expect(() => walk(PATHS.line.points, style)).toThrow(/paths\[0\]\.styles\[0\]\.style.*moonwalk/);
    expect(() => walk([[0, 0]])).toThrow(/paths\[0\]\.points/);
  });

  it("is the same every time", () => {
    const a = walk(PATHS.sine.points).motion.clip;
    const b = walk(PATHS.sine.points).motion.clip;
    expect(a.rotations).toEqual(b.rotations);
  });
});

describe("feet that hover", () => {
  const DEG = Math.PI / 180;
  /** One plant of sixty frames with the pitch given, settled; degrees. */
  const settled = (pitch: (f: number) => number): number[] => {
    const track = createFeetTrack(60);
    for (let f = 0; f < 60; f++) track.pitch[2 * f] = pitch(f) * DEG;
    settleFeet(track, [{ foot: "left", x: 0, z: 0, yaw: 0, from: 0, to: 60 }]);
    return range(60).map((f) => track.pitch[2 * f] / DEG);
  };

  it("toes that stay a little over their place come down, a heel that stays a little up lies down", () => {
    const toes = settled((f) => (f < 8 ? 20 - 2 * f : f < 30 ? 2.5 : 0));
    expect(Math.max(...toes.slice(10, 56))).toBeLessThan(0.8);
    expect(toes[2]).toBeCloseTo(16, 1);
    const heel = settled((f) => (f < 20 ? 0 : -3));
    expect(Math.min(...heel.slice(20, 56))).toBeGreaterThan(-1.2);
  });

  it("a foot that rolls from heel to toe as people's do is left alone", () => {
    const roll = (f: number) => (f < 5 ? 20 - 4 * f : f < 45 ? 0 : -3 * (f - 44));
    settled(roll).forEach((p, f) => {
      expect(p, `frame ${f}`).toBeCloseTo(roll(f), 6);
    });
  });
});

describe("changes of style [Express §6.2]", () => {
  /** Blend lengths from everywhere in a loop to where the other one is joined, seconds. */
  function lengths(from: string, to: string): number[] {
    const a = families.get(from)?.loop;
    const b = families.get(to)?.loop;
    if (!a || !b) throw new Error("no such style");
    return range(60 * a.strides).map((k) => blendAt(a, k / 60, b).length.frames / 60);
  }

  it("take between walking and balancing what the paper reports, by where they start", () => {
    for (const [from, to] of [
      ["walking", "balancing"],
      ["balancing", "walking"],
    ]) {
      const all = lengths(from, to);
      expect(Math.min(...all), `${from} to ${to}`).toBeGreaterThan(2.2);
      expect(Math.max(...all), `${from} to ${to}`).toBeLessThan(3.9);
      expect(Math.max(...all) - Math.min(...all)).toBeGreaterThan(0.8);
    }
  });

  it("take between energetic and tired what the paper reports, by where they start", () => {
    for (const [from, to] of [
      ["energetic", "tired"],
      ["tired", "energetic"],
    ]) {
      const all = lengths(from, to);
      expect(Math.min(...all), `${from} to ${to}`).toBeGreaterThan(1.3);
      expect(Math.max(...all), `${from} to ${to}`).toBeLessThan(1.8);
      expect(Math.max(...all) - Math.min(...all)).toBeGreaterThan(0.2);
    }
  });

  it("take what the body needs from one speed to the other, where hands would be quicker", () => {
    const all = lengths("jogging", "balancing");
    const slower =
      (60 * ((families.get("jogging")?.loop.speed ?? 0) - (families.get("balancing")?.loop.speed ?? 0))) /
      1.25;
    expect(slower).toBeGreaterThan(1);
    expect(Math.min(...all)).toBeGreaterThanOrEqual(slower - 1e-9);
  });

  it("are played as long as that, or for the fixed third of a second where that is wished for", () => {
    const points = [
      [0, 0],
      [0, 14],
    ];
    const styles = [{ at: 0.4, style: "balancing" }];
    const { blends } = walk(points, styles).motion.timeline;
    expect(blends).toHaveLength(1);
    expect(blends[0].frames / 60).toBeGreaterThan(2.2);
    expect(blends[0].frames).toBe(Math.round(blends[0].length.frames));
    const fixed = planPaths(sceneOf(points, styles), skeleton, families, { adaptive: false });
    expect(fixed.motion.timeline.blends[0].frames).toBe(Math.round(60 * FIXED_BLEND));
  });
});

describe("loops from one sample [Express §5]", () => {
  it("have the number of steps of [Express Table 1], by the criterion alone", () => {
    const steps = STYLES.map((style) => 2 * (families.get(style)?.loop.strides ?? 0));
    expect(steps).toEqual([2, 2, 4, 6, 4, 2, 4]);
  });

  it("of plain two steps lose what balancing and excited are", () => {
    for (const style of ["balancing", "excited"] as const) {
      const { clip } = renderScore(styleScore(style));
      const plain = cutLoop(clip, style, 2).choice;
      const own = cutLoop(clip, style).choice;
      expect(plain.chosen.loss, style).toBeGreaterThan(3 * own.chosen.loss);
      expect(plain.chosen.loss, style).toBeGreaterThan(own.limit);
    }
  });

  it("repeat a thousand times without drifting", () => {
    for (const [name, { loop }] of families) {
      const row = new Float64Array(ROW);
      const first = new Float64Array(ROW);
      loopRow(first, 0, loop, 0.25);
      loopRow(row, 0, loop, 1000 * loop.frames + 0.25);
      for (let k = 0; k < ROW; k++) expect(row[k], name).toBeCloseTo(first[k], 9);
    }
  });

  it.skipIf(!hasShared)("have a joint that pops no more than the sample itself", () => {
    let within = 0;
    let all = 0;
    let worst = 0;
    for (const file of captures().filter((f) => /_(walk|run)_/.test(f))) {
      const { clip } = importBvh(readFileSync(file, "utf8"), basename(file));
      const ratio = jointPopping(clip, cutLoop(clip, basename(file)));
      all++;
      if (ratio <= 1) within++;
      worst = Math.max(worst, ratio);
    }
    console.log(`joint against sample: within 1.0 in ${within} of ${all}, worst ${worst.toFixed(2)}`);
    expect(within).toBe(all);
  });

  it("come from any straight file, and names are told apart", () => {
    const text = writeBvh(renderScore(styleScore("tired")).clip);
    const loop = styleFromBvh(text, "Old-Walk_01.bvh", styleName("x/Old-Walk_01.bvh"));
    expect(loop.name).toBe("old walk 01");
    expect(styleFacts(loop)).toMatchObject({ name: "old walk 01", steps: 4 });
    expect(freeName("tired", STYLES)).toBe("tired 2");
    expect(() => styleFromBvh("HIERARCHY", "broken.bvh", "broken")).toThrow(/^broken\.bvh/);
  });

  it("are seamless: the frame after the last is as near the first as neighbours are", () => {
    for (const [name, { loop }] of families) {
      const stride = loop.rows.length / loop.frames;
      const step = (a: number, b: number) => {
        let most = 0;
        // Upper-body rotations and hip height; the way ahead grows.
        for (let k = 1; k < 3 + 56; k++)
          most = Math.max(most, Math.abs(loop.rows[a * stride + k] - loop.rows[b * stride + k]));
        return most;
      };
      let usual = 0;
      for (let f = 1; f < loop.frames; f++) usual = Math.max(usual, step(f - 1, f));
      expect(step(loop.frames - 1, 0), name).toBeLessThan(1.5 * usual + 5e-3);
    }
  });

  it.skipIf(!hasShared)("are found with no hand help in straight real walks and runs", () => {
    let found = 0;
    let tried = 0;
    const missed: string[] = [];
    for (const file of captures().filter((f) => /_(walk|run)_/.test(f))) {
      tried++;
      try {
        const { clip } = importBvh(readFileSync(file, "utf8"), basename(file));
        cutLoop(clip, basename(file));
        found++;
      } catch (error) {
        if (!(error instanceof StyleError)) throw error;
        missed.push(error.message);
      }
    }
    console.log(`${found} of ${tried} captures loop; ${missed.join(" | ")}`);
    expect(found / tried).toBeGreaterThan(0.9);
  });
});
