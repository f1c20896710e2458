/** Which step category follows which [TaskLoco Figure 5], learned from the captures: categories on a ring, arrows by share. */
import { STEP_CATEGORIES } from "../core/steps/types.ts";

export interface TransitionData {
  /** counts[a][b]: how often b follows a. */
  counts: readonly (readonly number[])[];
  colours: readonly string[];
  codes: readonly string[];
}

/** What the plot shows, in one sentence. */
export function transitionFinding(d: TransitionData): string {
  let best: [number, number] = [0, 0];
  d.counts.forEach((row, a) => {
    row.forEach((c, b) => {
      if (a !== b && c > d.counts[best[0]][best[1]]) best = [a, b];
    });
  });
  return `Most often ${STEP_CATEGORIES[best[1]]} follows ${STEP_CATEGORIES[best[0]]}.`;
}

/** SVG markup of the graph. */
export function transitionGraph(d: TransitionData, size = 272): string {
  const n = d.counts.length;
  const cx = size / 2;
  const cy = 112;
  const radius = 84;
  const at = (i: number): [number, number] => [
    cx + radius * Math.sin((2 * Math.PI * i) / n),
    cy - radius * Math.cos((2 * Math.PI * i) / n),
  ];
  const out: string[] = [];
  d.counts.forEach((row, a) => {
    const total = row.reduce((s, v) => s + v, 0) || 1;
    row.forEach((c, b) => {
      const share = c / total;
      if (share < 0.04) return;
      const [x1, y1] = at(a);
      const [x2, y2] = at(b);
      const w = (0.6 + 4 * share).toFixed(2);
      if (a === b) {
        const [ox, oy] = [(x1 - cx) / radius, (y1 - cy) / radius];
        out.push(
          `<circle cx="${(x1 + ox * 15).toFixed(1)}" cy="${(y1 + oy * 15).toFixed(1)}" r="8" fill="none" stroke="currentColor" stroke-width="${w}" opacity="0.45"/>`,
        );
        return;
      }
      // Bowed to the right of its way, so that both directions are seen.
      const mx = (x1 + x2) / 2 - (y2 - y1) * 0.14;
      const my = (y1 + y2) / 2 + (x2 - x1) * 0.14;
      const l = Math.hypot(x2 - mx, y2 - my);
      const ex = x2 - ((x2 - mx) / l) * 13;
      const ey = y2 - ((y2 - my) / l) * 13;
      out.push(
        `<path d="M${x1.toFixed(1)} ${y1.toFixed(1)}Q${mx.toFixed(1)} ${my.toFixed(1)} ${ex.toFixed(1)} ${ey.toFixed(1)}" fill="none" stroke="currentColor" stroke-width="${w}" opacity="0.45"/>`,
      );
      const ux = (x2 - mx) / l;
      const uy = (y2 - my) / l;
      out.push(
        `<path d="M${(ex + ux * 3).toFixed(1)} ${(ey + uy * 3).toFixed(1)}L${(ex - ux * 4 - uy * 3.4).toFixed(1)} ${(ey - uy * 4 + ux * 3.4).toFixed(1)}L${(ex - ux * 4 + uy * 3.4).toFixed(1)} ${(ey - uy * 4 - ux * 3.4).toFixed(1)}Z" fill="currentColor" opacity="0.7"/>`,
      );
    });
  });
  for (let i = 0; i < n; i++) {
    const [x, y] = at(i);
    out.push(
      `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="12" fill="${d.colours[i]}" stroke="currentColor"/><text class="strong" x="${x.toFixed(1)}" y="${(y + 3.5).toFixed(1)}" text-anchor="middle" style="fill:${i === 0 || i === 6 ? "#fff" : "#14181d"};font-size:9px">${d.codes[i]}</text>`,
    );
  }
  return `<svg class="plot" viewBox="0 0 ${size} 222" role="img" aria-label="${transitionFinding(d)}">${out.join("")}</svg>`;
}
