/**
 * The oracle as bytes: the labelled motions that it remembers, not their windows, which are made again on reading; and the
 * examples that it began with, where it began with any.
 *
 *     magic "SWO2" | uint32 length of the head | uint32 length of the body
 *     | head: deflated JSON | body: deflated Float32 points and roots | base: deflated bytes of examples
 */
import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";
import * as v from "valibot";
import { type Examples, packExamples, unpackExamples } from "./examples.ts";
import { FEATURE_SETS, featureSize } from "./features.ts";
import { LEG_ROW } from "./motion-track.ts";
import { type LabelledTrack, type Oracle, trainOracle } from "./oracle.ts";

const MAGIC = "SWO2";
const ROW = 2 * LEG_ROW + 4;

const whole = (low: number, high: number) =>
  v.pipe(v.number(), v.integer(), v.minValue(low), v.maxValue(high));
const share = v.pipe(v.number(), v.minValue(0), v.maxValue(1));
const head = v.object({
  options: v.object({
    set: v.picklist(FEATURE_SETS),
    half: whole(0, 120),
    k: whole(1, 1000),
    on: share,
    off: share,
    shortest: whole(0, 600),
  }),
  /** Starting examples; 0 for none. */
  base: whole(0, 5_000_000),
  tracks: v.array(
    v.object({
      name: v.string(),
      frames: whole(1, 2_000_000),
      leg: v.pipe(v.number(), v.minValue(0.1), v.maxValue(10)),
      labels: v.array(whole(0, 15)),
      mask: v.nullable(v.array(whole(0, 1))),
    }),
  ),
});
type Head = v.InferOutput<typeof head>;

/** What is wrong with the bytes of a model. */
export class ModelError extends Error {
  override name = "ModelError";
}

export function encodeOracle(oracle: Oracle): Uint8Array {
  const known: Head = {
    options: oracle.options,
    base: oracle.base?.count ?? 0,
    tracks: oracle.sources.map((s) => ({
      name: s.track.name,
      frames: s.track.frames,
      leg: s.track.leg,
      labels: [...s.labels],
      mask: s.mask ? [...s.mask] : null,
    })),
  };
  const total = oracle.sources.reduce((n, s) => n + s.track.frames, 0);
  const body = new Float32Array(total * ROW);
  let at = 0;
  for (const { track } of oracle.sources) {
    body.set(track.points, at);
    body.set(track.root, at + track.points.length);
    at += track.frames * ROW;
  }
  const json = deflateSync(strToU8(JSON.stringify(known)));
  const data = deflateSync(new Uint8Array(body.buffer));
  const base = oracle.base ? deflateSync(packExamples(oracle.base)) : new Uint8Array(0);
  const out = new Uint8Array(12 + json.length + data.length + base.length);
  out.set(strToU8(MAGIC), 0);
  const lengths = new DataView(out.buffer);
  lengths.setUint32(4, json.length, true);
  lengths.setUint32(8, data.length, true);
  out.set(json, 12);
  out.set(data, 12 + json.length);
  out.set(base, 12 + json.length + data.length);
  return out;
}

/** @throws ModelError when the bytes are no model, or broken. */
export function decodeOracle(bytes: Uint8Array, name: string): Oracle {
  if (bytes.length < 12 || strFromU8(bytes.subarray(0, 4)) !== MAGIC)
    throw new ModelError(`${name}: this is no contact model.`);
  const lengths = new DataView(bytes.buffer, bytes.byteOffset);
  const bodyFrom = 12 + lengths.getUint32(4, true);
  const baseFrom = bodyFrom + lengths.getUint32(8, true);
  let known: Head;
  let body: Float32Array;
  let base: Examples | null = null;
  try {
    known = v.parse(head, JSON.parse(strFromU8(inflateSync(bytes.subarray(12, bodyFrom)))));
    const raw = inflateSync(bytes.subarray(bodyFrom, baseFrom));
    if (raw.byteLength % 4 !== 0) throw new RangeError("no whole numbers");
    body = new Float32Array(raw.buffer.slice(raw.byteOffset, raw.byteOffset + raw.byteLength));
    if (known.base > 0)
      base = unpackExamples(inflateSync(bytes.subarray(baseFrom)), featureSize(known.options), known.base);
  } catch {
    throw new ModelError(`${name}: the contact model is damaged or cut short.`);
  }
  const damaged = (): ModelError => new ModelError(`${name}: the contact model is damaged or cut short.`);
  const frames = known.tracks.reduce((n, t) => n + t.frames, 0);
  if ((frames === 0 && !base) || frames * ROW !== body.length || !body.every(Number.isFinite))
    throw damaged();
  for (const t of known.tracks)
    if (t.labels.length !== t.frames || (t.mask && t.mask.length !== t.frames)) throw damaged();
  if (!base && !known.tracks.some((t) => !t.mask || t.mask.includes(1))) throw damaged();
  let at = 0;
  const sources: LabelledTrack[] = known.tracks.map((t) => {
    const size = 2 * LEG_ROW * t.frames;
    const track = {
      name: t.name,
      frames: t.frames,
      leg: t.leg,
      points: Float64Array.from(body.subarray(at, at + size)),
      root: Float64Array.from(body.subarray(at + size, at + size + 4 * t.frames)),
    };
    at += t.frames * ROW;
    return {
      track,
      labels: Uint8Array.from(t.labels),
      ...(t.mask ? { mask: Uint8Array.from(t.mask) } : {}),
    };
  });
  return trainOracle(sources, known.options, base);
}
