/**
 * The library as bytes: what the page loads. Clips, contacts, steps and tasks; mirror images and templates are made again on
 * reading, which is quicker than loading them.
 *
 *     magic "SWL1" | uint32 length of the head | head: deflated JSON | body: deflated int16 and int32 differences
 *
 * Rotations are rotation vectors in steps of pi / 32767 (under 0.05 mm at a foot), root in 1e-5 m, both as
 * differences from frame to frame, one channel after the other: such columns deflate to about a third.
 */
import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";
import * as v from "valibot";
import { sidecarTask } from "../capture/sidecar-file.ts";
import { quatFromRotationVector, quatToRotationVector } from "../math/quaternion.ts";
import { readJson } from "../scene/json-text.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import { createSkeleton } from "../skeleton/skeleton.ts";
import { FEET, PHASES, STEP_CATEGORIES } from "../steps/types.ts";
import { assembleLibrary } from "./build-library.ts";
import type { Library, LibraryClip } from "./types.ts";

const MAGIC = "SWL1";
const TURN = Math.PI / 32767;
const LENGTH = 1e-5;
const CHANNELS = 3 * JOINT_COUNT;

const number = v.pipe(v.number("a number is needed"), v.finite("a finite number is needed"));
const count = v.pipe(number, v.integer("a whole number is needed"), v.minValue(0, "at least 0 is needed"));
const factor = v.pipe(number, v.minValue(0.7, "at least 0.7"), v.maxValue(1.4, "at most 1.4"));
const footstep = v.object({ foot: v.picklist(FEET), x: number, y: number, z: number, yaw: number });
const step = v.object({
  foot: v.picklist(FEET),
  start: count,
  end: count,
  airStart: count,
  airEnd: count,
  category: v.picklist(STEP_CATEGORIES),
  phase: v.picklist(PHASES),
  from: footstep,
  to: footstep,
});
const clipHead = v.pipe(
  v.object({
    name: v.string(),
    height: v.pipe(number, v.minValue(1, "at least 1 m"), v.maxValue(2.5, "at most 2.5 m")),
    proportions: v.object({ leg: factor, arm: factor, torso: factor }),
    frames: v.pipe(count, v.minValue(1, "at least one frame is needed")),
    tasks: v.array(sidecarTask),
    steps: v.array(step),
    initialStance: v.tuple([footstep, footstep]),
    /** Run lengths of the contact byte: value, frames, ... */
    contacts: v.array(count),
  }),
  v.check(
    (c) => c.steps.every((s) => s.start <= s.end && Math.max(s.end, s.airEnd) < c.frames + 1),
    "a step outside of the clip",
  ),
  v.check(
    (c) => c.contacts.reduce((n, x, i) => (i % 2 === 1 ? n + x : n), 0) === c.frames,
    "contacts for another number of frames",
  ),
);
const libraryHead = v.object({ clips: v.array(clipHead) });
type ClipHead = v.InferOutput<typeof clipHead>;

/** What is wrong with the bytes of a library. */
export class LibraryError extends Error {
  override name = "LibraryError";
}

/** Bytes of the clips that are not mirror images. */
export function encodeLibrary(library: Library): Uint8Array {
  const originals = library.clips.filter((c) => !c.clip.name.endsWith("~"));
  const heads: ClipHead[] = originals.map((c) => ({
    name: c.clip.name,
    height: c.clip.skeleton.height,
    proportions: c.clip.skeleton.proportions,
    frames: c.clip.frames,
    tasks: c.tasks,
    steps: c.steps,
    initialStance: c.initialStance,
    contacts: runLengths(c.contacts),
  }));
  const total = originals.reduce((n, c) => n + c.clip.frames, 0);
  const bytes = new Uint8Array(total * (CHANNELS * 2 + 12));
  const view = new DataView(bytes.buffer);
  let at = 0;
  const rotation = new Float64Array(3);
  for (const { clip } of originals) {
    for (let k = 0; k < 3; k++) {
      let before = 0;
      for (let f = 0; f < clip.frames; f++) {
        const value = Math.round(clip.root[3 * f + k] / LENGTH);
        view.setInt32(at, value - before, true);
        before = value;
        at += 4;
      }
    }
    for (let j = 0; j < JOINT_COUNT; j++) {
      const columns = [0, 1, 2].map(() => new Int16Array(clip.frames));
      for (let f = 0; f < clip.frames; f++) {
        quatToRotationVector(rotation, 0, clip.rotations, 4 * (f * JOINT_COUNT + j));
        for (let k = 0; k < 3; k++) columns[k][f] = Math.round(rotation[k] / TURN);
      }
      for (const column of columns) {
        let before = 0;
        for (let f = 0; f < clip.frames; f++) {
          // Differences wrap in 16 bits, and back on reading.
          view.setInt16(at, ((column[f] - before) << 16) >> 16, true);
          before = column[f];
          at += 2;
        }
      }
    }
  }
  const head = deflateSync(strToU8(JSON.stringify({ clips: heads })), { level: 9 });
  const body = deflateSync(splitBytes(bytes), { level: 6 });
  const out = new Uint8Array(8 + head.length + body.length);
  out.set(strToU8(MAGIC), 0);
  new DataView(out.buffer).setUint32(4, head.length, true);
  out.set(head, 8);
  out.set(body, 8 + head.length);
  return out;
}

/**
 * The library of some bytes, with mirror images and templates.
 *
 * @throws LibraryError when they are no library, cut short or damaged.
 */
export function decodeLibrary(bytes: Uint8Array): Library {
  if (bytes.length < 8 || strFromU8(bytes.subarray(0, 4)) !== MAGIC)
    throw new LibraryError("library: the file does not begin with SWL1.");
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(4, true);
  if (8 + length > bytes.length)
    throw new LibraryError(`library: cut short: ${bytes.length} bytes, ${8 + length} or more expected.`);
  let heads: ClipHead[];
  let body: Uint8Array;
  try {
    heads = readHead(strFromU8(inflateSync(bytes.subarray(8, 8 + length))));
    body = joinBytes(inflateSync(bytes.subarray(8 + length)));
  } catch (error) {
    throw new LibraryError(`library: damaged: ${error instanceof Error ? error.message : String(error)}`);
  }
  const total = heads.reduce((n, c) => n + c.frames, 0);
  if (body.length !== total * (CHANNELS * 2 + 12))
    throw new LibraryError(
      `library: ${body.length} bytes of motion, ${total * (CHANNELS * 2 + 12)} expected.`,
    );
  // Every engine at hand is little-endian, as the file is; whole arrays are read several times faster than number by number.
  const words = new Int16Array(body.buffer, body.byteOffset, body.length >> 1);
  let at = 0;
  const column = (out: Int16Array): void => {
    let value = 0;
    for (let f = 0; f < out.length; f++) {
      value = ((value + words[at + f]) << 16) >> 16;
      out[f] = value;
    }
    at += out.length;
  };
  const clips = heads.map((h): LibraryClip => {
    const root = new Float64Array(3 * h.frames);
    const rotations = new Float64Array(4 * JOINT_COUNT * h.frames);
    for (let k = 0; k < 3; k++) {
      let value = 0;
      for (let f = 0; f < h.frames; f++) {
        value += (words[at] & 0xffff) | (words[at + 1] << 16);
        root[3 * f + k] = value * LENGTH;
        at += 2;
      }
    }
    const x = new Int16Array(h.frames);
    const y = new Int16Array(h.frames);
    const z = new Int16Array(h.frames);
    for (let j = 0; j < JOINT_COUNT; j++) {
      column(x);
      column(y);
      column(z);
      for (let f = 0; f < h.frames; f++)
        quatFromRotationVector(rotations, 4 * (f * JOINT_COUNT + j), x[f] * TURN, y[f] * TURN, z[f] * TURN);
    }
    sameHemisphere(rotations, h.frames);
    return {
      clip: {
        name: h.name,
        skeleton: createSkeleton(h.height, h.proportions),
        rate: 60,
        frames: h.frames,
        root,
        rotations,
      },
      contacts: fromRunLengths(h.contacts, h.frames),
      tasks: h.tasks,
      steps: h.steps,
      initialStance: h.initialStance,
    };
  });
  return assembleLibrary(clips, true);
}

/** The clips of a head. @throws Error with the path to what is wrong. */
function readHead(text: string): ClipHead[] {
  const result = v.safeParse(libraryHead, readJson(text), { abortEarly: true });
  if (!result.success)
    throw new Error(`${v.getDotPath(result.issues[0]) ?? "head"}: ${result.issues[0].message}`);
  return result.output.clips;
}

/** Low bytes first, then high ones: differences are small, so the high bytes are nearly all alike. */
function splitBytes(bytes: Uint8Array): Uint8Array {
  const half = bytes.length >> 1;
  const out = new Uint8Array(bytes.length);
  for (let i = 0; i < half; i++) {
    out[i] = bytes[2 * i];
    out[half + i] = bytes[2 * i + 1];
  }
  return out;
}

function joinBytes(bytes: Uint8Array): Uint8Array {
  const half = bytes.length >> 1;
  const out = new Uint8Array(bytes.length);
  for (let i = 0; i < half; i++) {
    out[2 * i] = bytes[i];
    out[2 * i + 1] = bytes[half + i];
  }
  return out;
}

function sameHemisphere(r: Float64Array, frames: number): void {
  const row = 4 * JOINT_COUNT;
  for (let i = row; i < frames * row; i += 4) {
    const b = i - row;
    if (r[i] * r[b] + r[i + 1] * r[b + 1] + r[i + 2] * r[b + 2] + r[i + 3] * r[b + 3] < 0)
      for (let k = 0; k < 4; k++) r[i + k] = -r[i + k];
  }
}

function runLengths(track: Uint8Array): number[] {
  const out: number[] = [];
  let from = 0;
  for (let f = 1; f <= track.length; f++) {
    if (f < track.length && track[f] === track[from]) continue;
    out.push(track[from], f - from);
    from = f;
  }
  return out;
}

function fromRunLengths(runs: readonly number[], frames: number): Uint8Array {
  const out = new Uint8Array(frames);
  let f = 0;
  for (let k = 0; k + 1 < runs.length; k += 2) {
    out.fill(runs[k], f, f + runs[k + 1]);
    f += runs[k + 1];
  }
  return out;
}
