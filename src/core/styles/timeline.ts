/**
 * Which frames of which loops are played when, and how far along the path [Express §6]: loops repeated, aligned by
 * key-times, blended over adaptive lengths from any frame, with the stride that the curvature allows.
 */
import { minimumJerk } from "../math/interpolate.ts";
import { type BlendLength, blendAt, blendLengths, FIXED_BLEND } from "./blend-length.ts";
import { type StrideFamily, strideScale } from "./family.ts";
import { type ContactPhases, frameOfPhase, phaseOfFrame } from "./gait-phase.ts";
import type { LoopSequence } from "./loop.ts";
import { type MotionPath, readPath, soften } from "./path.ts";

const RATE = 60;
/** Standing before the first and after the last step, frames. */
const STAND_BEFORE = 24;
const STAND_AFTER = 30;
/** Frames that any path takes at most: ten minutes. */
const MOST_FRAMES = 36000;
/** A foot that lands this near the end of the path stands in its last place, metres. */
const NEAR_END = 0.05;

export interface TimelineOptions {
  /** Blend lengths by end effectors [Express §6.2]; else 0.33 s. */
  adaptive: boolean;
  /** Shorter strides where the path curves [Express §7.2]. */
  stride: boolean;
  /** Begin and end standing; else in mid-stride, as the paper's motions do. */
  stand: boolean;
}

/** A change of style as it was timed. */
export interface StyleBlend {
  from: number;
  to: number;
  /** First frame of the blend and its length in frames. */
  start: number;
  length: BlendLength;
  frames: number;
  /** Where in a pass of the first style it began, strides; and the lengths that other starts would have, frames. */
  phase: number;
  starts: Float32Array;
}

/** A row a frame. */
export interface Timeline {
  frames: number;
  /** Way along the path, metres. */
  at: Float64Array;
  /** Stride scale, 0.5 to 1. */
  scale: Float64Array;
  /** 0 standing to 1 moving. */
  amount: Float64Array;
  /** Style (index of the families given) and its frame; style blended towards and its frame; weight of the latter. */
  styleA: Uint8Array;
  styleB: Uint8Array;
  frameA: Float64Array;
  frameB: Float64Array;
  weight: Float64Array;
  /** Bit 0: left foot down, bit 1: right foot down. */
  down: Uint8Array;
  blends: StyleBlend[];
  /** Frames at which a loop begins anew, with the style's index. */
  loopStarts: { frame: number; style: number }[];
  warnings: string[];
}

/** A style from a place on the path on. */
export interface StyleChange {
  /** Metres along the path. */
  at: number;
  style: number;
}

/** How far before and after a bend its stride holds, metres: a step is taken as a whole. */
const STEP_AROUND = 0.25;

/** Stride scale along the path, a value a row of it. A walker looks ahead: it shortens before the bend. */
export function scaleAlong(path: MotionPath): Float64Array {
  const reach = Math.round(STEP_AROUND / path.step);
  const raw = path.curvature.map((k) => strideScale(k));
  const least = raw.map((_, i) => {
    let m = 1;
    for (let k = Math.max(0, i - reach); k <= Math.min(raw.length - 1, i + reach); k++)
      m = Math.min(m, raw[k]);
    return m;
  });
  return soften(least, 0.15 / path.step);
}

function downBits(c: ContactPhases, d: ContactPhases, w: number, phase: number): number {
  const p = phase - Math.floor(phase);
  const mix = (a: number, b: number) => a + w * (b - a);
  const left = p < mix(c.leftLift, d.leftLift) || p >= mix(c.leftLand, d.leftLand);
  const right = p >= mix(c.rightLand, d.rightLand) && p < mix(c.rightLift, d.rightLift);
  return (left ? 1 : 0) | (right ? 2 : 0);
}

/**
 * Plays families along a path.
 *
 * @param families one a style; @param changes in order of `at`, the first at 0.
 */
export function createTimeline(
  path: MotionPath,
  families: readonly StrideFamily[],
  changes: readonly StyleChange[],
  options: TimelineOptions,
): Timeline {
  const scales = options.stride ? scaleAlong(path) : null;
  const out = {
    at: [] as number[],
    scale: [] as number[],
    amount: [] as number[],
    styleA: [] as number[],
    styleB: [] as number[],
    frameA: [] as number[],
    frameB: [] as number[],
    weight: [] as number[],
    down: [] as number[],
  };
  const blends: StyleBlend[] = [];
  const loopStarts: { frame: number; style: number }[] = [];
  const warnings: string[] = [];
  let style = changes[0].style;
  let loop = families[style].loop;
  let s = 0;
  // From standing the right foot lifts first: the left one has just taken over.
  let frameA = options.stand ? frameOfPhase(loop.phases, loop.contacts[0].rightLift - 0.004) : 0;
  let phase = options.stand ? loop.contacts[0].rightLift - 0.004 : 0;
  let offset = 0;
  let blend: StyleBlend | null = null;
  let frameB = 0;
  let startRamp = options.stand ? 0 : 1;
  let stopRamp = 1;
  let stopping = -1;
  const landedLate = [false, false];
  let before = 3;
  let hold = options.stand ? STAND_BEFORE : 0;
  const stepFrames = () => loop.frames / (2 * loop.strides);
  loopStarts.push({ frame: 0, style });
  for (;;) {
    const scale = scales ? Math.max(0.5, readPath(path, scales, s)) : 1;
    const amount = options.stand ? Math.min(minimumJerk(startRamp), minimumJerk(stopRamp)) : 1;
    const w = blend ? (1 - Math.cos((Math.PI * (out.at.length - blend.start)) / blend.frames)) / 2 : 0;
    const other = blend ? families[blend.to].loop : loop;
    const contactsA = loop.contacts[mod(Math.floor(phase), loop.strides)];
    const contactsB = other.contacts[mod(Math.floor(phase - offset), other.strides)];
    // A foot that has come to its last place stays there: a run has no moment in which both are down.
    const down =
      hold > 0
        ? 3
        : downBits(contactsA, contactsB, w, phase) | (landedLate[0] ? 1 : 0) | (landedLate[1] ? 2 : 0);
    out.at.push(s);
    out.scale.push(scale);
    out.amount.push(amount);
    out.styleA.push(style);
    out.styleB.push(blend ? blend.to : style);
    out.frameA.push(frameA);
    out.frameB.push(frameB);
    out.weight.push(w);
    out.down.push(down);
    const now = out.at.length;
    if (now >= MOST_FRAMES) {
      warnings.push(`path: it takes longer than ${MOST_FRAMES / RATE / 60} minutes and is cut off there.`);
      break;
    }
    if (hold > 0) {
      hold--;
      before = 3;
      continue;
    }
    // A foot that lands when the way is done stands where it will stay.
    for (let side = 0; side < 2; side++)
      if (stopping > 0 && (down >> side) & 1 & ~(before >> side) && path.length - s < NEAR_END)
        landedLate[side] = true;
    before = down;
    if (options.stand ? stopRamp <= 0 && landedLate[0] && landedLate[1] : s >= path.length) break;

    // A change of style begins wherever it is wanted, once the one before is done.
    const wanted = styleAt(changes, s);
    if (!blend && wanted !== style && stopping < 0) {
      const to = families[wanted].loop;
      const { stride, length } = blendAt(loop, phase, to);
      offset = Math.floor(phase) - stride;
      frameB = frameOfPhase(to.phases, phase - offset);
      const frames = Math.max(2, Math.round(options.adaptive ? length.frames : FIXED_BLEND * RATE));
      blend = {
        from: style,
        to: wanted,
        start: now,
        length,
        frames,
        phase: mod(phase, loop.strides),
        starts: blendLengths(loop, to),
      };
      blends.push(blend);
    }
    // Time goes on by one frame: of the style alone, or of both at the pace that is between theirs.
    let step: number;
    if (blend) {
      const b = families[blend.to].loop;
      const v = (1 - Math.cos((Math.PI * (now - blend.start)) / blend.frames)) / 2;
      phase = phaseAfter(loop, b, frameA, frameB, phase, offset, v);
      const a = frameOfPhase(loop.phases, phase);
      const c = frameOfPhase(b.phases, phase - offset);
      step = (1 - v) * loop.speed * (a - frameA) + v * b.speed * (c - frameB);
      frameA = a;
      frameB = c;
      if (now - blend.start >= blend.frames) {
        style = blend.to;
        loop = b;
        frameA = frameB;
        phase -= offset;
        offset = 0;
        blend = null;
        loopStarts.push({ frame: now, style });
      }
    } else {
      const pass = Math.floor(frameA / loop.frames);
      frameA += 1;
      phase = phaseOfFrame(loop.phases, frameA);
      step = loop.speed;
      if (Math.floor(frameA / loop.frames) !== pass) loopStarts.push({ frame: now, style });
    }
    if (options.stand) {
      startRamp = Math.min(1, startRamp + 1 / (1.15 * stepFrames()));
      const stopFrames = 1.3 * stepFrames();
      const left = path.length - s;
      if (stopping < 0 && left <= 0.5 * step * scale * amount * stopFrames) stopping = stopFrames;
      if (stopping > 0) stopRamp = Math.max(0, stopRamp - 1 / stopping);
    }
    let way = step * scale * amount;
    if (stopping > 0) {
      // What is left of the way is spread over what is left of the ramp, so that it ends on the path's end.
      const r = stopRamp;
      const ahead = stopping * step * scale * r ** 4 * (2.5 - 3 * r + r * r);
      const left = path.length - s;
      way =
        r > 0.05
          ? way * Math.max(0.4, Math.min(2, left / Math.max(1e-6, ahead)))
          : Math.min(0.01, 0.12 * left);
    }
    s += way;
    if (options.stand && s > path.length) s = path.length;
  }
  if (options.stand) {
    for (let k = 0; k < STAND_AFTER; k++) {
      for (const key of ["scale", "amount", "styleA", "styleB", "frameA", "frameB", "weight"] as const)
        out[key].push(out[key][out[key].length - 1]);
      out.at.push(out.at[out.at.length - 1]);
      out.down.push(3);
    }
  }
  return {
    frames: out.at.length,
    at: Float64Array.from(out.at),
    scale: Float64Array.from(out.scale),
    amount: Float64Array.from(out.amount),
    styleA: Uint8Array.from(out.styleA),
    styleB: Uint8Array.from(out.styleB),
    frameA: Float64Array.from(out.frameA),
    frameB: Float64Array.from(out.frameB),
    weight: Float64Array.from(out.weight),
    down: Uint8Array.from(out.down),
    blends,
    loopStarts,
    warnings,
  };
}

/**
 * The phase one frame on, where two loops are played at once: the mean of the frames that each goes on by, weighed as the
 * blend weighs them, is one. Sought by halving: near keys that fall together a pace says little about the next frame.
 */
function phaseAfter(
  a: LoopSequence,
  b: LoopSequence,
  frameA: number,
  frameB: number,
  phase: number,
  offset: number,
  weight: number,
): number {
  const passed = (p: number) =>
    (1 - weight) * (frameOfPhase(a.phases, p) - frameA) +
    weight * (frameOfPhase(b.phases, p - offset) - frameB);
  let low = phase;
  let high = phase + 1 / Math.min(a.frames, b.frames);
  while (passed(high) < 1) high += high - low;
  for (let k = 0; k < 40 && high - low > 1e-9; k++) {
    const middle = (low + high) / 2;
    if (passed(middle) < 1) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

const mod = (a: number, n: number): number => ((a % n) + n) % n;

function styleAt(changes: readonly StyleChange[], s: number): number {
  let style = changes[0].style;
  for (const c of changes) if (c.at <= s) style = c.style;
  return style;
}
