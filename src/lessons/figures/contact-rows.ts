/** Rows of contact over time, one a method, and how many frames each has wrong. */

import type { ContactTrack } from "../../core/steps/types.ts";
import { svgEl } from "../../embed/dom.ts";

export interface ContactRow {
  name: string;
  contacts: ContactTrack;
  /** Compared with this one, frames that differ are marked; null for the truth itself. */
  truth: ContactTrack | null;
}

/** Frames of one bit that differ, and plants that one side alone has. */
export function mistakes(a: ContactTrack, truth: ContactTrack, bit: number, from = 0, to = truth.length) {
  let frames = 0;
  for (let f = from; f < to; f++) if (((a[f] ^ truth[f]) >> bit) & 1) frames++;
  return { frames, share: frames / Math.max(1, to - from) };
}

function runs(c: ContactTrack, bit: number, from: number, to: number): [number, number][] {
  const out: [number, number][] = [];
  let start = -1;
  for (let f = from; f <= to; f++) {
    const on = f < to && ((c[f] >> bit) & 1) === 1;
    if (on && start < 0) start = f;
    if (!on && start >= 0) {
      out.push([start, f]);
      start = -1;
    }
  }
  return out;
}

/** Bars at `y` downwards, `x` maps frames to the drawing's units. */
export function contactRows(
  rows: readonly ContactRow[],
  bit: number,
  from: number,
  to: number,
  x: (frame: number) => number,
  y: number,
): SVGGElement {
  const g = svgEl("g");
  const colour = bit < 2 ? "var(--left)" : "var(--right)";
  rows.forEach((row, i) => {
    const top = y + 22 * i;
    g.append(svgEl("text", { x: x(from) - 6, y: top + 10, "text-anchor": "end" }, row.name));
    for (const [a, b] of runs(row.contacts, bit, from, to))
      g.append(
        svgEl("rect", {
          x: x(a),
          width: Math.max(1, x(b) - x(a)),
          y: top,
          height: 13,
          rx: 3,
          fill: colour,
          opacity: row.truth ? 0.85 : 0.45,
        }),
      );
    const { truth } = row;
    if (!truth) return;
    for (let f = from; f < to; f++) {
      if (!(((row.contacts[f] ^ truth[f]) >> bit) & 1)) continue;
      let end = f;
      while (end < to && ((row.contacts[end] ^ truth[end]) >> bit) & 1) end++;
      g.append(
        svgEl("rect", {
          x: x(f),
          width: Math.max(1.5, x(end) - x(f)),
          y: top + 14.5,
          height: 2.5,
          class: "wrong",
        }),
      );
      f = end;
    }
  });
  return g;
}
