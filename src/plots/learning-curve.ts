/** What an oracle gains by labels: lines over how much was labelled. Pure data in, SVG markup out. */
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { safe } from "./markup.ts";

export interface LearningSeries {
  /** Named at its end. */
  name: string;
  dashed: boolean;
  /** How much was labelled, and how well it knows, in the axes' units. */
  points: readonly (readonly [number, number])[];
}

export interface LearningPlot {
  width: number;
  height: number;
  /** Lowest and highest value shown. */
  range: readonly [number, number];
  xName: string;
  /** Written beside the last point of the first series, or "". */
  last: string;
  /** The finding in one sentence, for those who do not see it. */
  finding: string;
  series: readonly LearningSeries[];
}

const px = (v: number): string => v.toFixed(1);

/** SVG markup; colours are the page's tokens where it has them. */
export function learningCurve(plot: LearningPlot): string {
  const { width, height, series } = plot;
  const named = series.some((s) => s.name !== "");
  const right = named ? 96 : 12;
  const xs = series.flatMap((s) => s.points.map((p) => p[0]));
  const x = scaleLinear([Math.min(0, ...xs), Math.max(1e-9, ...xs)], [34, width - right]);
  const y = scaleLinear([...plot.range], [height - 24, 10]);
  const out: string[] = [];
  for (const t of y.ticks(3))
    out.push(
      `<line x1="34" x2="${width - right}" y1="${px(y(t))}" y2="${px(y(t))}" stroke="var(--line, #e2e2df)"/><text x="28" y="${px(y(t) + 4)}" text-anchor="end">${t}</text>`,
    );
  const path = line<readonly [number, number]>()
    .x((p) => x(p[0]))
    .y((p) => y(p[1]));
  series.forEach((s, i) => {
    if (s.points.length === 0) return;
    const [lx, ly] = s.points[s.points.length - 1];
    out.push(
      `<path d="${path([...s.points]) ?? ""}" fill="none" stroke="var(--ink, #16191d)" stroke-width="${i === 0 ? 1.6 : 1.2}"${s.dashed ? ' stroke-dasharray="4 3"' : ""}/>`,
    );
    if (i === 0)
      for (const p of s.points)
        out.push(
          `<circle cx="${px(x(p[0]))}" cy="${px(y(p[1]))}" r="3" fill="var(--paper, #fff)" stroke="var(--ink, #16191d)" stroke-width="1.5"/>`,
        );
    if (named)
      out.push(`<text x="${px(x(lx) + 8)}" y="${px(y(ly) + 4 + (i === 0 ? -4 : 6))}">${safe(s.name)}</text>`);
    if (i === 0 && plot.last !== "")
      out.push(
        `<text x="${px(Math.max(34 + 7 * plot.last.length, Math.min(width - right, x(lx))))}" y="${px(y(ly) + 18)}" text-anchor="end" fill="var(--ink, #16191d)" font-weight="500">${safe(plot.last)}</text>`,
      );
  });
  out.push(`<text x="${width - right}" y="${height - 6}" text-anchor="end">${safe(plot.xName)}</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="Geist Variable, system-ui, sans-serif" font-size="11" fill="var(--ink-3, #666d76)" role="img" aria-label="${safe(plot.finding)}">${out.join("")}</svg>`;
}
