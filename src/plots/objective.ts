/** The objective's terms while it is minimised [TaskLoco eq. 11]: pure data in, SVG markup out. */
import { max } from "d3-array";
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { safe } from "./markup.ts";

export interface ObjectiveData {
  /** One row an iteration: total, then the five weighted terms. */
  rows: readonly (readonly number[])[];
  /** Names of the columns of a row. */
  names: readonly string[];
}

/** Dash patterns of the terms; the total is a full, heavier line. */
const DASHES = ["", "", "5 3", "2 2", "7 2 2 2", "1 3"];

/** What the plot shows, in one sentence. */
export function objectiveFinding(d: ObjectiveData): string {
  if (d.rows.length < 2) return "Nothing was optimised here.";
  const first = d.rows[0][0];
  const last = d.rows[d.rows.length - 1][0];
  return `The objective fell from ${first.toFixed(3)} to ${last.toFixed(3)} in ${d.rows.length - 1} iterations.`;
}

/** SVG markup of the plot, `width` x `height`. */
export function objectivePlot(d: ObjectiveData, width = 272, height = 148): string {
  const right = 66;
  const bottom = 20;
  const top = 8;
  const n = Math.max(1, d.rows.length - 1);
  const most = max(d.rows, (r) => max(r) ?? 0) ?? 1;
  const y = scaleLinear([0, most || 1], [height - bottom, top]).nice(3);
  // Room for the longest number, 6.5 pixels a figure.
  const left = Math.max(34, 8 + 6.5 * (max(y.ticks(3), (t) => String(t).length) ?? 0));
  const x = scaleLinear([0, n], [left, width - right]);
  const path = line<number>(
    (_, i) => x(i),
    (v) => y(v),
  );
  const out: string[] = [];
  for (const t of y.ticks(3)) {
    out.push(
      `<line class="axis" x1="${left}" x2="${width - right}" y1="${y(t)}" y2="${y(t)}"/><text x="${left - 6}" y="${y(t) + 4}" text-anchor="end">${t}</text>`,
    );
  }
  for (const t of x.ticks(3).filter(Number.isInteger))
    out.push(`<text x="${x(t)}" y="${height - 4}" text-anchor="middle">${t}</text>`);
  const ends: { name: string; y: number; k: number }[] = [];
  d.names.forEach((name, k) => {
    const values = d.rows.map((r) => r[k]);
    if (k > 0 && (max(values) ?? 0) < 1e-9) return;
    out.push(
      `<path d="${path(values) ?? ""}" fill="none" stroke="currentColor" stroke-width="${k === 0 ? 2.2 : 1.1}" stroke-dasharray="${DASHES[k]}" opacity="${k === 0 ? 1 : 0.75}"/>`,
    );
    ends.push({ name, y: y(values[values.length - 1]), k });
  });
  // Names at the lines' ends, kept 12 px apart.
  ends.sort((a, b) => a.y - b.y);
  for (let i = 1; i < ends.length; i++) ends[i].y = Math.max(ends[i].y, ends[i - 1].y + 12);
  const over = (ends[ends.length - 1]?.y ?? 0) - (height - bottom);
  for (const e of ends)
    out.push(
      `<text class="${e.k === 0 ? "strong" : ""}" x="${width - right + 6}" y="${e.y - Math.max(0, over) + 4}">${safe(e.name)}</text>`,
    );
  return `<svg class="plot" viewBox="0 0 ${width} ${height}" role="img" aria-label="${safe(objectiveFinding(d))}">${out.join("")}</svg>`;
}
