/** Paths with style [Express]: loops from samples, blends, and walks along paths. */
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { importBvh } from "../../src/core/capture/import.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { readScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { FIXED_BLEND } from "../../src/core/styles/blend-length.ts";
import type { StrideFamily } from "../../src/core/styles/family.ts";
import { cutLoop, StyleError } from "../../src/core/styles/loop.ts";
import { nearestOnPath } from "../../src/core/styles/path.ts";
import { type PathPlan, planPaths } from "../../src/core/styles/plan-paths.ts";
import { styleFamilies } from "../../src/studio/style-families.ts";
import { STYLES } from "../../src/studio/styles.ts";
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
  const chunk = {
    first: 0,
    frames: clip.frames,
    root: Float32Array.from(clip.root),
    rotations: Float32Array.from(clip.rotations),
    contacts,
  };
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

  it("keeps the hips near the path, slower and shorter where it curves", () => {
    const { motion, path } = walk(PATHS.eight.points);
    let farthest = 0;
    for (let f = 0; f < motion.clip.frames; f++)
      farthest = Math.max(
        farthest,
        nearestOnPath(path, motion.clip.root[3 * f], motion.clip.root[3 * f + 2]).distance,
      );
    expect(farthest).toBeLessThan(0.12);
    const line = walk(PATHS.line.points).motion.timeline;
    const least = Math.min(...motion.timeline.scale);
    expect(Math.min(...line.scale)).toBeGreaterThan(0.99);
    expect(least).toBeLessThan(0.97);
    expect(least).toBeGreaterThanOrEqual(0.5);
  });

  it("follows fifty random paths with random styles without NaN or sliding", () => {
    const random = createRandom(11);
    for (let k = 0; k < 50; k++) {
      let heading = random.between(-3, 3);
      const at = [0, 0];
      const points = range(4 + Math.floor(6 * random.next())).map(() => {
        heading += random.between(-1, 1);
        at[0] += Math.sin(heading) * random.between(0.6, 1.6);
        at[1] += Math.cos(heading) * random.between(0.6, 1.6);
        return [...at];
      });
      const styles = range(3).map((i) => ({
        at: i / 3,
        style: STYLES[Math.floor(random.next() * STYLES.length)],
      }));
      const plan = walk(points, styles, random.next() < 0.7);
      expect(plan.motion.clip.rotations.every(Number.isFinite)).toBe(true);
      const q = qualityOf(plan);
      expect(q.skate ?? 0, `path ${k}`).toBeLessThan(4);
      expect(q.penetration ?? 0, `path ${k}`).toBeLessThan(3);
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

describe("changes of style [Express §6.2]", () => {
  it("blend over lengths that depend on where they start, unlike the fixed third of a second", () => {
    const lengths = [0.3, 0.33, 0.36, 0.4, 0.45, 0.5].map((at) => {
      const { motion } = walk(
        [
          [0, 0],
          [0, 14],
        ],
        [
          { at: 0, style: "walking" },
          { at, style: "balancing" },
        ],
      );
      return motion.timeline.blends[0].frames / 60;
    });
    expect(Math.max(...lengths) - Math.min(...lengths)).toBeGreaterThan(0.05);
    expect(Math.min(...lengths)).toBeGreaterThan(FIXED_BLEND);
    console.log("walking to balancing, seconds:", lengths.map((l) => l.toFixed(2)).join(" "));
  });
});

describe("loops from one sample [Express §5]", () => {
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
