/**
 * Labelled examples without the motions they come from: what a starting oracle ships as.
 *
 * Features are held in steps of 1/48, so that a byte holds each and the shipped examples are the same as those in memory.
 */

export interface Examples {
  /** Numbers an example. */
  size: number;
  count: number;
  /** count x size. */
  features: Float32Array;
  /** Labels of each example. */
  labels: Uint8Array;
}

const STEP = 48;

/** One feature as it is held: 0 to 5.3. */
export const heldFeature = (v: number): number => Math.max(0, Math.min(255, Math.round(v * STEP))) / STEP;

/** Bytes of all features: differences from the example two before, which is the same foot's. */
export function packExamples({ size, count, features, labels }: Examples): Uint8Array {
  const out = new Uint8Array(count * (size + 1));
  for (let k = 0; k < size; k++) {
    const at = (i: number): number => (i < 0 ? 0 : Math.round(features[i * size + k] * STEP));
    for (let i = 0; i < count; i++) out[k * count + i] = (at(i) - at(i - 2)) & 255;
  }
  out.set(labels, size * count);
  return out;
}

/** The inverse of `packExamples`. @throws RangeError when the bytes do not fit. */
export function unpackExamples(bytes: Uint8Array, size: number, count: number): Examples {
  if (bytes.length !== count * (size + 1)) throw new RangeError("bytes of other examples");
  const features = new Float32Array(count * size);
  for (let k = 0; k < size; k++) {
    const values = bytes.slice(k * count, (k + 1) * count);
    for (let i = 0; i < count; i++) {
      if (i > 1) values[i] += values[i - 2];
      features[i * size + k] = values[i] / STEP;
    }
  }
  return { size, count, features, labels: bytes.slice(size * count) };
}
