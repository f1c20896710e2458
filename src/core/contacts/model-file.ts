/**
 * The oracle as bytes: the labelled motions that it remembers, not their windows, which are made again on reading.
 *
 *     magic "SWO1" | uint32 length of the head | head: deflated JSON | body: deflated Float32 points and roots
 */
import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";
import { LEG_ROW } from "./motion-track.ts";
import { type LabelledTrack, type Oracle, type OracleOptions, trainOracle } from "./oracle.ts";

const MAGIC = "SWO1";
const ROW = 2 * LEG_ROW + 4;

interface Head {
  options: OracleOptions;
  tracks: { name: string; frames: number; leg: number; labels: number[]; mask: number[] | null }[];
}

/** What is wrong with the bytes of a model. */
export class ModelError extends Error {
  override name = "ModelError";
}

export function encodeOracle(oracle: Oracle): Uint8Array {
  const head: Head = {
    options: oracle.options,
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
  const json = deflateSync(strToU8(JSON.stringify(head)));
  const data = deflateSync(new Uint8Array(body.buffer));
  const out = new Uint8Array(8 + json.length + data.length);
  out.set(strToU8(MAGIC), 0);
  new DataView(out.buffer).setUint32(4, json.length, true);
  out.set(json, 8);
  out.set(data, 8 + json.length);
  return out;
}

/** @throws ModelError when the bytes are no model, or broken. */
export function decodeOracle(bytes: Uint8Array, name: string): Oracle {
  if (bytes.length < 8 || strFromU8(bytes.subarray(0, 4)) !== MAGIC)
    throw new ModelError(`${name}: this is no contact model.`);
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(4, true);
  let head: Head;
  let body: Float32Array;
  try {
    head = JSON.parse(strFromU8(inflateSync(bytes.subarray(8, 8 + length)))) as Head;
    const raw = inflateSync(bytes.subarray(8 + length));
    body = new Float32Array(raw.buffer.slice(raw.byteOffset, raw.byteOffset + raw.byteLength));
  } catch {
    throw new ModelError(`${name}: the contact model is damaged or cut short.`);
  }
  let at = 0;
  const sources: LabelledTrack[] = head.tracks.map((t) => {
    const size = 2 * LEG_ROW * t.frames;
    if (at + t.frames * ROW > body.length)
      throw new ModelError(`${name}: the contact model is damaged or cut short.`);
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
  return trainOracle(sources, head.options);
}
