/** Medians and spreads of repeated measurements. */
import type { Figure } from "./types.ts";

export const median = (values: readonly number[]): number =>
  [...values].sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;

/** A figure from its measurements, without a peer. */
export function figure(
  name: string,
  unit: string,
  values: readonly number[],
  goal: string | null,
  ok: (median: number) => boolean,
): Figure {
  const m = median(values);
  return {
    name,
    unit,
    median: m,
    min: Math.min(...values),
    max: Math.max(...values),
    n: values.length,
    peer: null,
    peerMedian: null,
    ratio: null,
    goal,
    ok: goal === null ? null : ok(m),
  };
}
