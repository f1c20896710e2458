/** Files of magic, lengths, a deflated JSON head and a deflated body: libraries ("SWL1") and contact models ("SWO2"). */
import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";

/** Where the parts lie: a library says its head's length alone, a model its head's and its body's. */
function parts(bytes: Uint8Array): { start: number; head: number; body: number } {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const model = strFromU8(bytes.subarray(0, 4)) === "SWO2";
  const start = model ? 12 : 8;
  const head = start + view.getUint32(4, true);
  return { start, head, body: model ? head + view.getUint32(8, true) : bytes.length };
}

/** The JSON head's text. */
export function headOf(bytes: Uint8Array): string {
  const { start, head } = parts(bytes);
  return strFromU8(inflateSync(bytes.subarray(start, head)));
}

/** The same file with another head, and another body where `change` is given. */
export function repacked(
  bytes: Uint8Array,
  text: string,
  change: ((raw: Uint8Array) => Uint8Array) | null = null,
): Uint8Array {
  const at = parts(bytes);
  const json = deflateSync(strToU8(text));
  const old = bytes.subarray(at.head, at.body);
  const body = change ? deflateSync(change(inflateSync(old))) : old;
  const rest = bytes.subarray(at.body);
  const out = new Uint8Array(at.start + json.length + body.length + rest.length);
  out.set(bytes.subarray(0, 4));
  const view = new DataView(out.buffer);
  view.setUint32(4, json.length, true);
  if (at.start === 12) view.setUint32(8, body.length, true);
  out.set(json, at.start);
  out.set(body, at.start + json.length);
  out.set(rest, at.start + json.length + body.length);
  return out;
}
