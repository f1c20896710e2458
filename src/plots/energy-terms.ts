/** What each step of a plan costs, by term: stacked bars, pure data in, SVG out [Footsteps eqs. 13-16]. */
import { max, sum } from "d3-array";
import { scaleLinear } from "d3-scale";

export interface EnergyStep {
  /** One letter: W walk, S start, H halt, R rest, A aside. */
  code: string;
  /** J/kg: rate over time, change of speed, bend, nearness to others. */
  terms: [number, number, number, number];
}

export const ENERGY_TERMS = ["time", "speed", "bend", "nearness"] as const;
/** Series are told apart by lightness and dashes, not by hue: no category is meant. */
const SHADES = ["var(--ink)", "var(--ink-3)", "var(--ink-4)", "none"];

/** The finding in one sentence. */
export function energyFinding(steps: readonly EnergyStep[]): string {
  if (steps.length === 0) return "No plan.";
  const totals = ENERGY_TERMS.map((_, t) => sum(steps, (s) => s.terms[t]));
  const all = sum(totals);
  const most = totals.indexOf(max(totals) as number);
  return `${steps.length} steps cost ${all.toFixed(1)} J/kg; most for ${ENERGY_TERMS[most]}, ${Math.round((100 * totals[most]) / Math.max(all, 1e-9))} %.`;
}

/** Bars of a plan's steps, in order. */
export function energyPlot(steps: readonly EnergyStep[], width = 272, height = 132): string {
  const left = 26;
  const bottom = 18;
  const top = 8;
  const right = 62;
  const tallest = Math.max(1, max(steps, (s) => sum(s.terms)) ?? 1);
  const y = scaleLinear([0, tallest], [height - bottom, top]).nice(3);
  const room = (width - left - right) / Math.max(1, steps.length);
  const bar = Math.min(22, room * 0.72);
  const out: string[] = [];
  for (const tick of y.ticks(3))
    out.push(
      `<line x1="${left}" x2="${width - right + 4}" y1="${y(tick).toFixed(1)}" y2="${y(tick).toFixed(1)}" stroke="var(--line)"/>`,
      `<text x="${left - 4}" y="${(y(tick) + 3.5).toFixed(1)}" text-anchor="end">${tick}</text>`,
    );
  let ends: number[] = [];
  steps.forEach((s, i) => {
    const x = left + i * room + (room - bar) / 2;
    let at = 0;
    ends = s.terms.map((v, t) => {
      const [y0, y1] = [y(at), y(at + v)];
      at += v;
      if (v > 0.005)
        out.push(
          `<rect x="${x.toFixed(1)}" y="${y1.toFixed(1)}" width="${bar.toFixed(1)}" height="${Math.max(0.5, y0 - y1).toFixed(1)}" fill="${SHADES[t]}"${t === 3 ? ' stroke="var(--ink)" stroke-dasharray="2 2"' : ""}/>`,
        );
      return (y0 + y1) / 2;
    });
    out.push(`<text x="${(x + bar / 2).toFixed(1)}" y="${height - 5}" text-anchor="middle">${s.code}</text>`);
  });
  // Named at their ends, pushed apart where they would meet.
  let last = height;
  if (steps.length > 0)
    ENERGY_TERMS.forEach((name, t) => {
      const at = Math.min(ends[t] + 4, last - 12);
      last = at;
      out.push(`<text x="${width - right + 8}" y="${at.toFixed(1)}">${name}</text>`);
    });
  return `<svg viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" class="plot" role="img" aria-label="${energyFinding(steps)}" font-size="11" fill="var(--ink-2)">${out.join("")}</svg>`;
}
