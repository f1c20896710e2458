/** Length of a change of style by where it begins [Express §6.2], beside the fixed length of earlier work; data in, SVG markup out. */
import { max } from "d3-array";
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";

const WIDTH = 240;
const HEIGHT = 92;
const LEFT = 30;
const RIGHT = 8;
const TOP = 8;
const BOTTOM = 20;

export interface BlendLengthsData {
  /** Seconds, from starts evenly over one pass of the first style. */
  seconds: readonly number[];
  /** Steps of that pass. */
  steps: number;
  /** Seconds that a blend of fixed length takes. */
  fixed: number;
  /** The start chosen, share of the pass. */
  chosen: number;
  /** Whether lengths are adaptive: else the chosen one is the fixed length. */
  adaptive: boolean;
}

export function blendLengthsSvg(d: BlendLengthsData): string {
  const n = d.seconds.length;
  const most = max(d.seconds) ?? d.fixed;
  const x = scaleLinear([0, 1], [LEFT, WIDTH - RIGHT]);
  const y = scaleLinear([0, Math.max(most, d.fixed)], [HEIGHT - BOTTOM, TOP]).nice(3);
  const at = (share: number): number => d.seconds[Math.round(share * n) % n];
  const path = line<number>(
    (k) => x(k / n),
    (k) => y(d.seconds[k % n]),
  )(Array.from({ length: n + 1 }, (_, k) => k));
  const grid = y
    .ticks(3)
    .map(
      (t) =>
        `<line x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${y(t).toFixed(1)}" y2="${y(t).toFixed(1)}" stroke="var(--line)"/><text x="${LEFT - 5}" y="${(y(t) + 3.5).toFixed(1)}" text-anchor="end">${t}</text>`,
    )
    .join("");
  const steps = Array.from({ length: d.steps }, (_, k) => {
    const a = x((k + 0.5) / d.steps).toFixed(1);
    return `<text x="${a}" y="${HEIGHT - 6}" text-anchor="middle">step ${k + 1}</text>`;
  }).join("");
  const label = `Blend length by where it begins: ${Math.min(...d.seconds).toFixed(2)} to ${most.toFixed(2)} s; fixed ${d.fixed} s`;
  const chosen = d.adaptive ? at(d.chosen) : d.fixed;
  return `<svg class="blend-lengths" viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label="${label}" style="width:100%;font-size:10px;fill:var(--ink-2)">${grid}<text x="4" y="${TOP + 2}">s</text>${steps}<line x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${y(d.fixed).toFixed(1)}" y2="${y(d.fixed).toFixed(1)}" stroke="var(--ink-2)" stroke-dasharray="4 3"/><text x="${WIDTH - RIGHT}" y="${(y(d.fixed) - 3).toFixed(1)}" text-anchor="end">fixed</text><path d="${path ?? ""}" fill="none" stroke="var(--ink)" stroke-width="1.5"/><circle cx="${x(d.chosen).toFixed(1)}" cy="${y(chosen).toFixed(1)}" r="3.5" fill="var(--ink)"/></svg>`;
}
