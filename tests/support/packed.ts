/** Files of magic, length of the head, deflated JSON head, deflated body: libraries and contact models. */
import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";

/** Where the body begins. */
const bodyOf = (bytes: Uint8Array): number =>
  8 + new DataView(bytes.buffer, bytes.byteOffset).getUint32(4, true);

/** The JSON head's text. */
export const headOf = (bytes: Uint8Array): string => strFromU8(inflateSync(bytes.subarray(8, bodyOf(bytes))));

/** The same file with another head, and another body where `change` is given. */
export function repacked(
  bytes: Uint8Array,
  text: string,
  change: ((raw: Uint8Array) => Uint8Array) | null = null,
): Uint8Array {
  const json = deflateSync(strToU8(text));
  const old = bytes.subarray(bodyOf(bytes));
  const body = change ? deflateSync(change(inflateSync(old))) : old;
  const out = new Uint8Array(8 + json.length + body.length);
  out.set(bytes.subarray(0, 4));
  new DataView(out.buffer).setUint32(4, json.length, true);
  out.set(json, 8);
  out.set(body, 8 + json.length);
  return out;
}
