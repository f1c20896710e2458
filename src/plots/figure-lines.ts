/** Measured figures against a size, as lines on logarithmic axes: pure data in, SVG markup out. */
import { extent } from "d3-array";
import { scaleLog } from "d3-scale";
import { line } from "d3-shape";
import { safe } from "./markup.ts";

export interface FigureLine {
  name: string;
  /** Size and value, both over 0. */
  points: readonly (readonly [number, number])[];
  /** Single points, not joined: what a paper states. */
  loose?: boolean;
}

const COLOURS = ["#2f6f8f", "#9aa1a8", "#b5483a", "#2f6f5a"];
const short = (v: number): string =>
  v >= 1e6 ? `${v / 1e6} M` : v >= 1000 ? `${v / 1000} k` : `${Number(v.toPrecision(3))}`;

/** SVG markup that stands alone, 720 by 360. Every point is marked; a line's name stands at its end. */
export function figureLines(lines: readonly FigureLine[], title: string, x: string, y: string): string {
  const [width, height, left, right, top, bottom] = [720, 360, 58, 190, 44, 46];
  const all = lines.flatMap((l) => l.points);
  const [x0, x1] = extent(all, (p) => p[0]) as [number, number];
  const [y0, y1] = extent(all, (p) => p[1]) as [number, number];
  const sx = scaleLog([x0, x1], [left, width - right]);
  const sy = scaleLog([y0 / 1.4, y1 * 1.4], [height - bottom, top]);
  const out = [
    `<text x="12" y="24" font-size="16" font-weight="600">${safe(title)}</text>`,
    `<text x="${(left + width - right) / 2}" y="${height - 10}" text-anchor="middle">${safe(x)}</text>`,
    `<text transform="translate(14 ${(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">${safe(y)}</text>`,
  ];
  for (const v of [...new Set(lines.flatMap((l) => l.points.map((p) => p[0])))]) {
    const at = sx(v).toFixed(1);
    out.push(
      `<line x1="${at}" x2="${at}" y1="${top}" y2="${height - bottom}" stroke="#e4e6e8"/>`,
      `<text x="${at}" y="${height - bottom + 16}" text-anchor="middle">${short(v)}</text>`,
    );
  }
  for (const v of sy.ticks(4).filter((t) => Number.isInteger(Math.log10(t)))) {
    const at = sy(v).toFixed(1);
    out.push(
      `<line x1="${left}" x2="${width - right}" y1="${at}" y2="${at}" stroke="#e4e6e8"/>`,
      `<text x="${left - 6}" y="${(sy(v) + 4).toFixed(1)}" text-anchor="end">${short(v)}</text>`,
    );
  }
  const path = line<readonly [number, number]>(
    (p) => sx(p[0]),
    (p) => sy(p[1]),
  );
  // Names at the lines' ends, apart from each other.
  const names = lines
    .map((l, i) => ({ l, i, y: sy(l.points[l.points.length - 1][1]) }))
    .sort((a, b) => a.y - b.y);
  for (let k = 1; k < names.length; k++) names[k].y = Math.max(names[k].y, names[k - 1].y + 16);
  for (const { l, i, y: at } of names) {
    const colour = COLOURS[i % COLOURS.length];
    if (!l.loose)
      out.push(`<path d="${path(l.points) ?? ""}" fill="none" stroke="${colour}" stroke-width="2"/>`);
    for (const [px, py] of l.points)
      out.push(`<circle cx="${sx(px).toFixed(1)}" cy="${sy(py).toFixed(1)}" r="3.5" fill="${colour}"/>`);
    out.push(
      `<text x="${width - right + 10}" y="${(at + 4).toFixed(1)}" fill="${colour}">${safe(l.name)}</text>`,
    );
  }
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="12" fill="#16191d" role="img" aria-label="${safe(title)}"><rect width="${width}" height="${height}" fill="#fff"/>${out.join("")}</svg>\n`;
}
