/** Hip, knee and ankle over the gait cycle, before the range of real walkers: pure data in, SVG markup out. */
import { scaleLinear } from "d3-scale";
import { area, line } from "d3-shape";

export interface GaitCurveData {
  joint: string;
  /** What up and down mean, in one word each. */
  up: string;
  down: string;
  /** Degrees over 0 to 100 % of the cycle, evenly spaced; the spread of ours from cycle to cycle. */
  mean: ArrayLike<number>;
  sd: ArrayLike<number>;
  /** Real walkers' mean and spread, evenly spaced; null where there are none to compare with. */
  real: { mean: readonly number[]; sd: readonly number[] } | null;
  /** Share of the cycle at which the foot leaves the ground. */
  toeOff: number;
  /** Degrees, the axis. */
  domain: readonly [number, number];
}

/** Value of an evenly spaced curve at a share of the cycle. */
function read(curve: ArrayLike<number>, u: number): number {
  const x = u * (curve.length - 1);
  const i = Math.min(curve.length - 2, Math.floor(x));
  return curve[i] + (x - i) * (curve[i + 1] - curve[i]);
}

/** Share of the cycle in which ours lies inside the real range, one spread on either side; null without a range. */
export function insideShare(d: GaitCurveData): number | null {
  if (!d.real) return null;
  let n = 0;
  for (let k = 0; k <= 100; k++)
    if (Math.abs(read(d.mean, k / 100) - read(d.real.mean, k / 100)) <= read(d.real.sd, k / 100)) n++;
  return n / 101;
}

/** What the plot shows, in one sentence. */
export function gaitFinding(d: GaitCurveData): string {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (let k = 0; k < d.mean.length; k++) {
    low = Math.min(low, d.mean[k]);
    high = Math.max(high, d.mean[k]);
  }
  const inside = insideShare(d);
  const range = `The ${d.joint.toLowerCase()} goes from ${low.toFixed(0)}° to ${high.toFixed(0)}°`.replace(
    "-",
    "\u2212",
  );
  return inside === null
    ? `${range}.`
    : `${range}, ${Math.round(100 * inside)} % of the cycle inside the real range.`;
}

/** SVG markup of one joint's plot. */
export function gaitPlot(d: GaitCurveData, width = 300, height = 136): string {
  const left = 34;
  const right = 10;
  const top = 10;
  const bottom = 20;
  const x = scaleLinear([0, 1], [left, width - right]);
  const y = scaleLinear(d.domain, [height - bottom, top]);
  const out: string[] = [];
  for (const t of y.ticks(3))
    out.push(
      `<line class="axis" x1="${left}" x2="${width - right}" y1="${y(t).toFixed(1)}" y2="${y(t).toFixed(1)}"/><text x="${left - 6}" y="${(y(t) + 4).toFixed(1)}" text-anchor="end">${`${t}`.replace("-", "\u2212")}</text>`,
    );
  const at = Array.from({ length: 51 }, (_, k) => k / 50);
  if (d.real) {
    const { mean, sd } = d.real;
    const band = area<number>(
      (u) => x(u),
      (u) => y(read(mean, u) - read(sd, u)),
      (u) => y(read(mean, u) + read(sd, u)),
    );
    out.push(`<path class="real" d="${band(at) ?? ""}"/>`);
    const middle = line<number>(
      (u) => x(u),
      (u) => y(read(mean, u)),
    );
    out.push(`<path class="real-mean" d="${middle(at) ?? ""}"/>`);
  }
  const ours = line<number>(
    (u) => x(u),
    (u) => y(read(d.mean, u)),
  );
  out.push(
    `<line class="off" x1="${x(d.toeOff).toFixed(1)}" x2="${x(d.toeOff).toFixed(1)}" y1="${top}" y2="${height - bottom}"/>`,
    `<path class="ours" d="${ours(at) ?? ""}"/>`,
    `<text x="${left}" y="${height - 5}">0 %</text>`,
    `<text x="${width - right}" y="${height - 5}" text-anchor="end">100 %</text>`,
    `<text x="${x(d.toeOff).toFixed(1)}" y="${height - 5}" text-anchor="middle">toe off</text>`,
  );
  return `<svg class="plot gait" viewBox="0 0 ${width} ${height}" role="img" aria-label="${gaitFinding(d)}">${out.join("")}</svg>`;
}
