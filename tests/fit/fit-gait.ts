/**
 * Fits the numbers of one gait shape to averages of real walkers: `npm run fit -- NAME [ROUNDS]`, with the reference
 * material beside the repository. Prints the shape to be copied to src/studio/gait-shapes.ts, and how it stands.
 *
 * Damped Gauss-Newton by differences. Residuals: hip, knee and ankle over max(SD, 2 degrees), excursions, clearance and
 * toe lift, joints that turn faster than people's do, jerk beyond theirs, balance, rough keys, and the distance from the start.
 */
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { balanceShares } from "../../src/core/quality/balance.ts";
import { type GaitAnalysis, measureGait } from "../../src/core/quality/gait.ts";
import { paceOf, steadyFrames } from "../../src/core/quality/kind.ts";
import { motionPoints } from "../../src/core/quality/measure.ts";
import { jerkRatios } from "../../src/core/quality/smoothness.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import type { Plan } from "../../src/core/tasks/plan-types.ts";
import type { GaitShape } from "../../src/studio/gait-shape.ts";
import { curveShares, type StrideSwings, type Swing, strideSwings } from "../support/gait-real.ts";
import { middleOf, perform } from "./perform.ts";
import { RECIPES, type Recipe, targetOf } from "./recipes.ts";

/** Keys that are fitted and how far each may sensibly go: the scale of its step and of its prior. */
const KEYS: Partial<Record<keyof GaitShape, number>> = {
  push: 8,
  strike: 5,
  flat: 0.015,
  heelRise: 0.1,
  heelPower: 0.4,
  pushOverSwing: 0.12,
  strikeOverSwing: 0.08,
  way: 0.03,
  rise: 0.012,
  pressure: 0.025,
  outward: 0.006,
  heights: 0.008,
  early: 0.15,
  pelvisYaw: 3,
  pelvisLead: 0.3,
  pelvisTilt: 2,
  lean: 2,
};
/** Angular accelerations of real walkers and runners at 30 Hz, 99.9th percentile, radians per second squared. */
const USUAL: [number, number][] = [
  [J.leftUpperLeg, 150],
  [J.leftLowerLeg, 240],
  [J.leftFoot, 400],
  [J.leftToes, 450],
];

/** Widths of the differences, in each number's scale: where one finds no way down, the next does, past ripples of the knees' limits. */
const STEPS = [0.15, 0.4, 0.05];
/** Jerk that costs nothing, over real walkers' median, and how much more does. */
const LIKE_REAL = 0.9;
const JERK_WEIGHT = 2.5;

/** The pelvis's part of the chest's lean. */
const PELVIS_PART = 0.5;
/** Where a shape keeps each swing: its mean, amount and lag. */
const SWING_KEYS = {
  chest: [null, "chestYaw", "chestLag"],
  arm: ["armMean", "armSwing", "armLag"],
  out: ["armOut", "armOpen", "armOpenLag"],
  elbow: ["elbowMean", "elbowSwing", "elbowLag"],
  twice: [null, "elbowTwice", "elbowTwiceLag"],
} as const;

interface Slot {
  key: keyof GaitShape;
  index: number | null;
  scale: number;
}

function slotsOf(shape: GaitShape, run: boolean): Slot[] {
  const out: Slot[] = [];
  for (const [name, scale] of Object.entries(KEYS)) {
    const key = name as keyof GaitShape;
    const value = shape[key];
    if (key === "early" && !run) continue;
    if (typeof value === "number") out.push({ key, index: null, scale });
    else
      for (let i = 0; i < value.length; i++) {
        // Ends that are fixed by definition.
        if (key === "pushOverSwing" && (i === 0 || i === 10)) continue;
        if (key === "strikeOverSwing" && (i < 4 || i === 10)) continue;
        if ((key === "way" || key === "rise") && (i === 0 || i === 10)) continue;
        out.push({ key, index: i, scale });
      }
  }
  return out;
}

function withValues(shape: GaitShape, slots: readonly Slot[], x: Float64Array): GaitShape {
  const out = structuredClone(shape) as unknown as Record<string, number | number[]>;
  slots.forEach((s, k) => {
    if (s.index === null) out[s.key] = (out[s.key] as number) + x[k] * s.scale;
    else (out[s.key] as number[])[s.index] += x[k] * s.scale;
  });
  return out as unknown as GaitShape;
}

interface Look {
  gait: GaitAnalysis;
  /** Per joint, over the usual. */
  turning: number[];
  balance: number;
  /** By name: jerk of hands, feet, head and hips over real walkers' at the speed. */
  jerk: Map<string, number>;
  swings: StrideSwings;
  /** How much the hips had to give way for the knees, root mean square, metres. */
  raise: number;
}

function look(recipe: Recipe, shape: GaitShape): Look | null {
  const { clip, contacts, raise } = perform(recipe, shape, 12);
  const gait = measureGait(clip, contacts);
  if (!gait) return null;
  const turning = USUAL.map(([joint, usual]) => {
    let most = 0;
    const q = clip.rotations;
    for (let f = 60; f < clip.frames - (recipe.gains ? 6 : 90); f++) {
      let s = 0;
      const w = (a: number, b: number, k: number) => {
        // Small rotation between two frames, component k of twice the vector part of conj(a) b.
        const o = 4 * (JOINT_COUNT * a + joint);
        const p = 4 * (JOINT_COUNT * b + joint);
        const [x, y, z, v] = [q[o], q[o + 1], q[o + 2], q[o + 3]];
        const [X, Y, Z, V] = [q[p], q[p + 1], q[p + 2], q[p + 3]];
        const d = [
          v * X - x * V - y * Z + z * Y,
          v * Y - y * V - z * X + x * Z,
          v * Z - z * V - x * Y + y * X,
        ];
        return 2 * d[k] * 30;
      };
      for (let k = 0; k < 3; k++) s += ((w(f, f + 2, k) - w(f - 2, f, k)) * 30) ** 2;
      most = Math.max(most, Math.sqrt(s));
    }
    return most / (usual * (recipe.run ? 1.5 : 1));
  });
  const points = motionPoints(clip.skeleton, [wholeChunk(clip, contacts)], clip.frames);
  const nothing = { tasks: [] } as unknown as Plan;
  const level = new Float64Array(clip.frames);
  const pace = paceOf(points.root, points.yaw, clip.frames, 60);
  const going = steadyFrames(pace, 60);
  let speed = 0;
  let count = 0;
  let given = 0;
  for (let f = 0; f < clip.frames; f++) {
    if (!going[f]) continue;
    speed += pace.speeds[f];
    given += raise[f] ** 2;
    count++;
  }
  const leg = clip.skeleton.legLength - clip.skeleton.foot.ankleHeight;
  const jerk = jerkRatios(
    points.joints,
    clip.frames,
    60,
    leg,
    recipe.run ? "run" : "walk",
    speed / Math.max(1, count),
    (f) => going[f] === 1,
  );
  if (!jerk) return null;
  return {
    gait,
    turning,
    jerk,
    swings: strideSwings(points.joints, clip.frames, middleOf(clip.frames)),
    raise: Math.sqrt(given / Math.max(1, count)),
    balance: balanceShares(points, clip.skeleton, nothing, [], [level, level]).near ?? 0,
  };
}

/** Difference of two swings as vectors, degrees. */
const apart = ([, a, x]: Swing, [, b, y]: Swing): [number, number] => [
  a * Math.cos(x) - b * Math.cos(y),
  a * Math.sin(x) - b * Math.sin(y),
];

/**
 * The shape with chest and arms set so that they are seen to swing as the recipe says: what is seen differs from what is set by
 * little and evenly, so a few corrections settle it.
 */
function settleSwings(recipe: Recipe, shape: GaitShape): GaitShape {
  const set: Record<string, number> = {};
  for (const name of ["chest", "arm", "out", "elbow", "twice"] as const) {
    const [mean, swing, lag] = SWING_KEYS[name];
    if (mean) set[mean] = shape[mean];
    set[swing] = shape[swing];
    set[lag] = shape[lag];
  }
  for (let round = 0; round < 5; round++) {
    const seen = look(recipe, { ...shape, ...set })?.swings;
    if (!seen) throw new Error("no steady cycle");
    for (const name of ["chest", "arm", "out", "elbow", "twice"] as const) {
      const [mean, swing, lag] = SWING_KEYS[name];
      const aim = recipe.swings[name];
      if (mean) set[mean] += aim[0] - seen[name][0];
      const [c, s] = apart(aim, seen[name]);
      const x = set[swing] * Math.cos(set[lag]) + c;
      const y = set[swing] * Math.sin(set[lag]) + s;
      set[swing] = Math.hypot(x, y);
      const turn = Math.atan2(y, x);
      // Lags about half a turn, where most are, do not wrap, so that two shapes can be blended.
      set[lag] = name === "twice" || turn >= 0 ? turn : turn + 2 * Math.PI;
    }
  }
  return { ...shape, ...set };
}

function residuals(recipe: Recipe, shape: GaitShape, x: Float64Array): number[] | null {
  const seen = look(recipe, shape);
  if (!seen) return null;
  const target = targetOf(recipe);
  const out: number[] = [];
  for (const joint of ["hip", "knee", "ankle"] as const) {
    const { mean, sd } = target.curves_deg[joint];
    for (let k = 0; k < 101; k += 2)
      out.push(
        ((seen.gait[joint].mean[k] - mean[k]) / Math.max(recipe.softness ?? 2, sd[k])) * Math.sqrt(2 / 101),
      );
  }
  const f = seen.gait.facts;
  const off = (ours: number, real: { mean: number; sd: number }, least: number) =>
    (ours - real.mean) / Math.max(least, 0.7 * real.sd);
  out.push(0.8 * off(100 * f.pelvisVertical, target.pelvis_vertical_excursion_cm, 0.5));
  out.push(0.3 * off(100 * f.pelvisLateral, target.pelvis_lateral_excursion_cm, 1.2));
  out.push(0.8 * Math.min(0, off(100 * f.tipClearance, target.swing_min_tip_clearance_cm, 0.3)));
  out.push(0.3 * off(100 * f.toeLift, target.swing_max_toe_joint_lift_cm, 1.5));
  for (const t of seen.turning) out.push(1.5 * Math.max(0, t - 1));
  // The hands' is the arms', which are set.
  for (const [end, j] of seen.jerk)
    if (!end.includes("Hand"))
      out.push(JERK_WEIGHT * Math.log(Math.max(1, j / (LIKE_REAL * (recipe.jerk ?? 1)))));
  out.push(0.5 * (seen.raise / 0.003));
  // The curves, told against the vertical, would have the trunk lean back to bring the hips ahead.
  out.push((0.8 * (f.trunkLean - recipe.trunk)) / 1.5);
  // The curves do not tell how the pelvis turns, and would have it do the legs' work.
  for (const d of apart(seen.swings.pelvis, recipe.swings.pelvis)) out.push((0.5 * d) / 1.5);
  // Nor what the pelvis does under the trunk: it takes its part of the lean, with no hollow and no round back.
  out.push((0.5 * (shape.pelvisTilt - PELVIS_PART * shape.lean)) / 2);
  if (!recipe.run) out.push(8 * Math.max(0, (recipe.balance ?? 0.9) - seen.balance));
  const rough = (keys: readonly number[], scale: number, period: boolean) => {
    const n = keys.length;
    for (let i = period ? 0 : 2; i < (period ? n : n - 1); i++) {
      const d = keys[(i + n - 1) % n] - 2 * keys[i] + keys[(i + 1) % n];
      out.push((0.25 * d) / scale);
    }
  };
  rough(shape.pushOverSwing, 0.5, false);
  rough(shape.strikeOverSwing, 0.3, false);
  rough(shape.rise, 0.04, false);
  rough(shape.way, 0.06, false);
  rough(shape.heights, 0.02, true);
  // Pressure stays in the foot; a runner's whole body need not balance over it.
  for (const p of shape.pressure) {
    const over = Math.max(0, p - (recipe.run ? 0.3 : 0.185), (recipe.run ? -0.15 : -0.04) - p);
    out.push(over / 0.01);
  }
  for (const v of x) out.push(0.06 * v);
  return out;
}

/** Solves (A + damp) d = b, dense, by Cholesky-free elimination; sizes are some sixty. */
function solve(a: number[][], b: number[], damp: number): Float64Array {
  const n = b.length;
  const m = a.map((row, i) => [...row.map((v, j) => (i === j ? v * (1 + damp) + 1e-6 : v)), b[i]]);
  for (let i = 0; i < n; i++) {
    let p = i;
    for (let r = i + 1; r < n; r++) if (Math.abs(m[r][i]) > Math.abs(m[p][i])) p = r;
    [m[i], m[p]] = [m[p], m[i]];
    for (let r = i + 1; r < n; r++) {
      const k = m[r][i] / m[i][i];
      if (k !== 0) for (let c = i; c <= n; c++) m[r][c] -= k * m[i][c];
    }
  }
  const x = new Float64Array(n);
  for (let i = n - 1; i >= 0; i--) {
    let s = m[i][n];
    for (let c = i + 1; c < n; c++) s -= m[i][c] * x[c];
    x[i] = s / m[i][i];
  }
  return x;
}

const cost = (r: readonly number[]): number => r.reduce((s, v) => s + v * v, 0);

function report(recipe: Recipe, shape: GaitShape): string {
  const seen = look(recipe, shape);
  if (!seen) return "no steady cycle";
  const target = targetOf(recipe);
  const rows = (["hip", "knee", "ankle"] as const).map((joint) => {
    const s = curveShares(seen.gait, target, joint);
    return `${joint} ${s.once.toFixed(2)}/${s.twice.toFixed(2)} rms ${s.rms.toFixed(1)}`;
  });
  const f = seen.gait.facts;
  return `${rows.join(", ")}; turning ${seen.turning.map((t) => t.toFixed(2)).join(" ")}; balance ${seen.balance.toFixed(2)}; vertical ${(100 * f.pelvisVertical).toFixed(1)}, lateral ${(100 * f.pelvisLateral).toFixed(1)}, clearance ${(100 * f.tipClearance).toFixed(1)}, toe lift ${(100 * f.toeLift).toFixed(1)}, raise ${(1000 * seen.raise).toFixed(1)} mm, jerk ${[...seen.jerk.values()].map((j) => j.toFixed(2)).join(" ")}, stance ${f.stance.toFixed(2)}, trunk ${f.trunkLean.toFixed(1)}, ${Object.entries(
    seen.swings,
  )
    .map(([k, [m, a, l]]) => `${k} ${m.toFixed(0)} + ${a.toFixed(1)} at ${l.toFixed(2)}`)
    .join(", ")}`;
}

export async function main(args: string[]): Promise<number> {
  const recipe = RECIPES[args[0] ?? ""];
  if (!recipe) {
    console.error(`A recipe is needed: ${Object.keys(RECIPES).join(", ")}.`);
    return 2;
  }
  const rounds = Number(args[1] ?? 10);
  const start = settleSwings(recipe, recipe.start);
  const slots = slotsOf(start, recipe.run ?? false);
  let x = new Float64Array(slots.length);
  let r = residuals(recipe, start, x);
  if (!r) throw new Error("The start has no steady cycle.");
  console.error(`start ${cost(r).toFixed(2)}: ${report(recipe, start)}`);
  let damp = 0.1;
  let width = 0;
  let failed = 0;
  for (let round = 0; round < rounds; round++) {
    const step = STEPS[width];
    const columns = slots.map((_, k) => {
      const at = (d: number) => {
        const y = Float64Array.from(x);
        y[k] += d;
        return residuals(recipe, withValues(start, slots, y), y);
      };
      const [ahead, behind] = [at(step), at(-step)];
      return ahead && behind
        ? ahead.map((v, i) => (v - behind[i]) / (2 * step))
        : new Array(r?.length ?? 0).fill(0);
    });
    const normal = columns.map((a) => columns.map((b) => a.reduce((s, v, i) => s + v * b[i], 0)));
    const slope = columns.map((a) => -a.reduce((s, v, i) => s + v * (r as number[])[i], 0));
    let better = false;
    for (let attempt = 0; attempt < 6 && !better; attempt++) {
      const d = solve(normal, slope, damp);
      const y = x.map((v, k) => v + Math.max(-1.5, Math.min(1.5, d[k])));
      const moved = residuals(recipe, withValues(start, slots, y), y);
      if (moved && cost(moved) < cost(r) - 1e-4) {
        x = y;
        r = moved;
        better = true;
        damp = Math.max(1e-3, damp / 3);
      } else damp *= 4;
    }
    const shape = withValues(start, slots, x);
    console.error(
      `round ${round + 1} ${cost(r).toFixed(2)} damp ${damp.toFixed(3)}: ${report(recipe, shape)}`,
    );
    failed = better ? 0 : failed + 1;
    if (failed === STEPS.length) break;
    if (!better) {
      width = (width + 1) % STEPS.length;
      damp = 0.1;
    }
  }
  const final = settleSwings(recipe, withValues(start, slots, x));
  console.error(`settled: ${report(recipe, final)}`);
  console.log(JSON.stringify(final, (_, v) => (typeof v === "number" ? Math.round(v * 1e4) / 1e4 : v)));
  return 0;
}
