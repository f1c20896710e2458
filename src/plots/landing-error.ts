/** How far the blend alone misses each footstep, before inverse kinematics [Barycentric Figure 8]: columns, a step each. */
import { max } from "d3-array";
import { scaleBand, scaleLinear } from "d3-scale";

export interface LandingErrorData {
  /** Metres, in the order of the steps. */
  errors: readonly number[];
  feet: readonly ("left" | "right")[];
  /** Index of the step shown now; -1 for none. */
  now: number;
}

/** What the plot shows, in one sentence. */
export function landingErrorFinding(d: LandingErrorData): string {
  const sorted = d.errors.filter(Number.isFinite).sort((a, b) => a - b);
  if (sorted.length === 0) return "No foot has landed yet.";
  const p95 = sorted[Math.min(sorted.length - 1, Math.floor(0.95 * sorted.length))];
  return `The blend alone is within ${(100 * p95).toFixed(1)} cm for 95 % of the landings; inverse kinematics takes the rest.`;
}

/** SVG markup, `width` x `height`. */
export function landingErrorPlot(d: LandingErrorData, width = 272, height = 96): string {
  const left = 30;
  const bottom = 14;
  const x = scaleBand(
    d.errors.map((_, i) => i),
    [left, width],
  ).padding(0.25);
  const most = Math.max(0.05, max(d.errors, (v) => (Number.isFinite(v) ? v : 0)) ?? 0);
  const y = scaleLinear([0, most], [height - bottom, 8]).nice(3);
  const out: string[] = [];
  for (const t of y.ticks(3))
    out.push(
      `<path class="axis" d="M${left} ${y(t).toFixed(1)}H${width}"/><text x="0" y="${(y(t) + 3.5).toFixed(1)}">${Math.round(100 * t)} cm</text>`,
    );
  d.errors.forEach((v, i) => {
    if (!Number.isFinite(v)) return;
    out.push(
      `<rect x="${(x(i) ?? 0).toFixed(1)}" y="${y(v).toFixed(1)}" width="${x.bandwidth().toFixed(1)}" height="${Math.max(1, y(0) - y(v)).toFixed(1)}" rx="1" fill="${i === d.now ? "var(--ink)" : `var(--${d.feet[i]})`}"><title>Step ${i + 1}: ${(1000 * v).toFixed(0)} mm</title></rect>`,
    );
  });
  return `<svg class="plot" viewBox="0 0 ${width} ${height}" role="img" aria-label="${landingErrorFinding(d)}">${out.join("")}</svg>`;
}
