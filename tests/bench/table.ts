/** What was measured as one table of text, its columns as wide as what stands in them. */
import type { Figure } from "./types.ts";

const value = (v: number | null, unit: string): string =>
  v === null || !Number.isFinite(v)
    ? ""
    : `${Math.abs(v) >= 100 ? v.toFixed(0) : v.toPrecision(3)} ${unit}`.trimEnd();

/** Figure, median, peer with its own median in the same run, ratio, goal and whether it is met. */
export function table(figures: readonly Figure[]): string {
  const rows = [
    ["figure", "measured", "peer, same run", "ratio", "goal", ""],
    ...figures.map((f) => [
      f.name,
      value(f.median, f.unit) || "not measured",
      f.peer === null ? "" : `${f.peer} ${value(f.peerMedian, f.unit)}`.trimEnd(),
      f.ratio === null || !Number.isFinite(f.ratio) ? "" : f.ratio.toFixed(3),
      f.goal ?? "",
      f.ok === null ? "" : f.ok ? "met" : "not met",
    ]),
  ];
  const widths = rows[0].map((_, k) => Math.max(...rows.map((r) => r[k].length)));
  return rows
    .map((r) =>
      r
        .map((cell, k) => (k === 1 || k === 3 ? cell.padStart(widths[k]) : cell.padEnd(widths[k])))
        .join("  ")
        .trimEnd(),
    )
    .join("\n");
}
