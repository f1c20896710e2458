/**
 * A foot's space [Barycentric Figures 3, 4, 6]: landing points, their triangulation and hull, the query, the triangle hit and
 * its weights, the root's landing r. Pure data in, SVG markup out.
 */
import { extent } from "d3-array";
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { safe } from "./markup.ts";

export interface FootSpaceData {
  /** Landing points, lateral and forward by turns, metres. */
  points: readonly number[];
  /** Corners of the triangles, three by three; the hull's corners in order. */
  triangles: readonly number[];
  hull: readonly number[];
  names: readonly string[];
  title: string;
  /** The live query; null when this foot has none. */
  hit: {
    query: readonly [number, number];
    landing: readonly [number, number];
    root: readonly [number, number];
    triangle: number;
    /** Clips blended and their weights. */
    clips: readonly number[];
    weights: readonly number[];
  } | null;
}

/** What the plot shows, in one sentence. */
export function footSpaceFinding(d: FootSpaceData): string {
  if (!d.hit) return `${d.title}: ${d.points.length / 2} landing points.`;
  const most = d.hit.weights.indexOf(Math.max(...d.hit.weights));
  return `${d.title}: the step is ${Math.round(100 * d.hit.weights[most])} % ${d.names[d.hit.clips[most]]}.`;
}

/** SVG markup, `width` x `height`; lateral grows to the left, as the character sees it from behind. */
export function footSpacePlot(d: FootSpaceData, width = 136, height = 250): string {
  const xs = d.points.filter((_, i) => i % 2 === 0);
  const zs = d.points.filter((_, i) => i % 2 === 1);
  const q = d.hit?.query;
  const [x0 = 0, x1 = 1] = extent(q ? [...xs, q[0]] : xs);
  const [z0 = 0, z1 = 1] = extent(q ? [...zs, q[1]] : zs);
  const left = 6;
  const scale = Math.min((width - 2 * left) / (x1 - x0), (height - 30) / (z1 - z0));
  const cx = (x0 + x1) / 2;
  const x = scaleLinear([cx, cx + 1], [width / 2, width / 2 - scale]);
  const z = scaleLinear([z0, z0 + 1], [height - 12, height - 12 - scale]);
  const at = (i: number): [number, number] => [x(d.points[2 * i]), z(d.points[2 * i + 1])];
  const path = line<number>(
    (i) => at(i)[0],
    (i) => at(i)[1],
  );
  const out: string[] = [];
  for (let t = 0; t < d.triangles.length; t += 3) {
    const hit = d.hit !== null && t === 3 * d.hit.triangle;
    const corners = [d.triangles[t], d.triangles[t + 1], d.triangles[t + 2]];
    out.push(
      `<path d="${path(corners)}Z" fill="currentColor" fill-opacity="${hit ? 0.14 : 0}" stroke="currentColor" stroke-opacity="${hit ? 0.9 : 0.16}" stroke-width="${hit ? 1.2 : 0.7}"/>`,
    );
  }
  out.push(
    `<path d="${path([...d.hull])}Z" fill="none" stroke="currentColor" stroke-opacity="0.55" stroke-width="1.2"/>`,
  );
  const weight = new Map(d.hit?.clips.map((c, k) => [c, d.hit?.weights[k] ?? 0]));
  for (let i = 0; i < d.points.length / 2; i++) {
    const [px, pz] = at(i);
    const w = weight.get(i) ?? 0;
    const r = w > 0 ? 2 + 5 * Math.sqrt(w) : 1.4;
    out.push(
      `<circle cx="${px.toFixed(1)}" cy="${pz.toFixed(1)}" r="${r.toFixed(1)}" fill="currentColor" fill-opacity="${w > 0 ? 1 : 0.45}"><title>${safe(d.names[i])}${w > 0 ? `: ${(100 * w).toFixed(0)} %` : ""}</title></circle>`,
    );
  }
  // The root, from which everything is seen.
  out.push(
    `<path d="M${(x(0) - 4).toFixed(1)} ${(z(0) + 3).toFixed(1)}L${x(0).toFixed(1)} ${(z(0) - 6).toFixed(1)}L${(x(0) + 4).toFixed(1)} ${(z(0) + 3).toFixed(1)}Z" fill="none" stroke="currentColor"/>`,
  );
  if (d.hit) {
    const [qx, qz] = [x(d.hit.query[0]), z(d.hit.query[1])];
    const [rx, rz] = [x(d.hit.root[0]), z(d.hit.root[1])];
    const [lx, lz] = [x(d.hit.landing[0]), z(d.hit.landing[1])];
    out.push(
      `<path d="M${qx.toFixed(1)} ${qz.toFixed(1)}L${rx.toFixed(1)} ${rz.toFixed(1)}" stroke="currentColor" stroke-dasharray="2 3"/>`,
      `<rect x="${(rx - 3).toFixed(1)}" y="${(rz - 3).toFixed(1)}" width="6" height="6" fill="var(--paper)" stroke="currentColor" transform="rotate(45 ${rx.toFixed(1)} ${rz.toFixed(1)})"><title>r: the root's landing</title></rect>`,
      `<circle cx="${lx.toFixed(1)}" cy="${lz.toFixed(1)}" r="2.4" fill="var(--paper)" stroke="currentColor"><title>where the mix lands</title></circle>`,
      `<g stroke="currentColor" fill="none"><circle cx="${qx.toFixed(1)}" cy="${qz.toFixed(1)}" r="7"/><path d="M${(qx - 10).toFixed(1)} ${qz.toFixed(1)}h20M${qx.toFixed(1)} ${(qz - 10).toFixed(1)}v20"/></g>`,
    );
  }
  out.push(`<text class="strong" x="4" y="11">${safe(d.title)}</text>`);
  return `<svg class="plot" viewBox="0 0 ${width} ${height}" role="img" aria-label="${safe(footSpaceFinding(d))}">${out.join("")}</svg>`;
}

export interface WeightData {
  /** lambda_1..3 and lambda_4; beta. */
  lambda: readonly number[];
  lambda4: number;
  beta: number;
}

/** Width of a letter of a plot's text, no less than it is, px. */
const LETTER = 6.2;

/** lambda_1 to lambda_4 as one bar, with beta marked [Figure 6]. */
export function weightBar(d: WeightData, width = 272): string {
  const height = 44;
  const x = scaleLinear([0, 1], [0, width]);
  const parts = [...d.lambda, d.lambda4];
  const out: string[] = [];
  let from = 0;
  /** Where the last label ends. */
  let said = 0;
  parts.forEach((w, k) => {
    if (w < 1e-4) return;
    out.push(
      `<rect x="${x(from).toFixed(1)}" y="14" width="${Math.max(0, x(w) - 1).toFixed(1)}" height="14" rx="2" fill="currentColor" fill-opacity="${k === 3 ? 0.25 : 0.9 - 0.22 * k}"/>`,
    );
    const label = `${k === 3 ? "λ₄ root" : `λ${"₁₂₃"[k]}`} ${w.toFixed(2)}`;
    // A narrow part at the right end has its label moved in.
    const place = Math.min(x(from) + 2, width - LETTER * label.length);
    if (x(w) > 26 && place >= said) {
      out.push(`<text x="${place.toFixed(1)}" y="40">${label}</text>`);
      said = place + LETTER * label.length;
    }
    from += w;
  });
  // Beta counts the share of lambda_4, which stands at the right.
  const b = x(1 - d.beta);
  out.push(
    `<path d="M${b.toFixed(1)} 10v22" stroke="currentColor" stroke-width="1.5"/><text x="${Math.max(2, Math.min(width - 52, b - 20)).toFixed(1)}" y="9">β ${d.beta.toFixed(2)}</text>`,
  );
  return `<svg class="plot" viewBox="0 0 ${width} ${height}" role="img" aria-label="Weights ${parts.map((w) => w.toFixed(2)).join(", ")}; beta ${d.beta.toFixed(2)}.">${out.join("")}</svg>`;
}
