/** One or two small lines over a performance: what a layer does. Pure data in, SVG markup out. */
import { extent } from "d3-array";
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { safe } from "./markup.ts";

/** SVG markup of tracks with a value a frame on one scale; `says` is what they are, `unit` the scale's. */
export function layerLine(
  lines: readonly ArrayLike<number>[],
  says: string,
  unit: string,
  width = 150,
  height = 30,
): string {
  let low = 0;
  let high = 0;
  for (const l of lines) {
    const [a, b] = extent(Array.from(l));
    low = Math.min(low, a ?? 0);
    high = Math.max(high, b ?? 0);
  }
  const flat = high - low < 1e-6;
  const y = scaleLinear(flat ? [-1, 1] : [low, high], [height - 3, 3]);
  const out = lines.map((l, k) => {
    const x = scaleLinear([0, Math.max(1, l.length - 1)], [0, width]);
    // A point in two frames is as fine as the screen.
    const at = Array.from({ length: Math.ceil(l.length / 2) }, (_, i) => 2 * i);
    const path = line<number>(
      (f) => x(f),
      (f) => y(l[f]),
    );
    return `<path class="${k === 0 ? "first" : "second"}" d="${path(at) ?? ""}"/>`;
  });
  const range = flat
    ? "nothing"
    : `${low.toFixed(1)} to ${high.toFixed(1)} ${unit}`.replaceAll("-", "\u2212");
  return `<svg class="plot layer-line" viewBox="0 0 ${width} ${height}" preserveAspectRatio="none" role="img" aria-label="${safe(`${says}: ${range}`)}">${out.join("")}</svg>`;
}
