/** The labelling desk's picture: four label tracks, height and speed curves, ruler and playhead. Pure data in, SVG markup out. */
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";

/** Pixels at the left for names. */
export const DESK_LEFT = 82;
const RULER = 22;
const TRACK = 26;
const GAPS = [0, 4, 14, 4];
const EDGE = 6;

export const TRACK_NAMES = ["Left heel", "Left toe", "Right heel", "Right toe"] as const;

export interface DeskRun {
  from: number;
  to: number;
  /** Least certainty of the oracle in it, 0 to 1; null when a person has confirmed it. */
  sure: number | null;
}

export interface DeskPicture {
  width: number;
  height: number;
  /** Frames shown, [first, last). */
  first: number;
  last: number;
  cursor: number;
  /** Track at hand, and whether the brush is down. */
  track: number;
  brush: boolean;
  tracks: readonly (readonly DeskRun[])[];
  /** frames x 4 of the whole clip, from frame 0. */
  heights: Float32Array;
  speeds: Float32Array;
}

const px = (v: number): string => v.toFixed(1);

/** Frames to pixels and back. */
export const deskScale = (p: Pick<DeskPicture, "first" | "last" | "width">) =>
  scaleLinear([p.first, Math.max(p.first + 1, p.last)], [DESK_LEFT, p.width - 8]).clamp(true);

/** Top of a track, pixels. */
export const trackTop = (track: number): number =>
  RULER + GAPS.slice(0, track + 1).reduce((a, b) => a + b, 0) + track * (TRACK + 2);

/** SVG markup. Runs carry data-track, data-from and data-to; their ends data-edge. */
export function contactTracks(p: DeskPicture): string {
  const x = deskScale(p);
  const out: string[] = [];
  const every = [5, 10, 20, 50, 100].find((k) => x(p.first + k) - x(p.first) > 60) ?? 200;
  for (let f = Math.ceil(p.first / every) * every; f < p.last; f += every)
    out.push(
      `<line x1="${px(x(f))}" x2="${px(x(f))}" y1="18" y2="${p.height}" stroke="var(--line)"/><text x="${px(x(f) + 3)}" y="13">${f}</text>`,
    );
  for (let t = 0; t < 4; t++) out.push(trackSvg(p, t, x));
  const tops = trackTop(3) + TRACK + 14;
  const each = Math.max(30, (p.height - tops - 10) / 2);
  out.push(
    curvesSvg(p, p.heights, tops, each, x, "Height", 100, "cm"),
    curvesSvg(p, p.speeds, tops + each + 8, each, x, "Speed", 1, "m/s"),
  );
  const c = x(p.cursor + 0.5);
  out.push(
    `<g pointer-events="none"><line x1="${px(c)}" x2="${px(c)}" y1="16" y2="${p.height}" stroke="var(--paper)" stroke-width="5" opacity=".7"/><line x1="${px(c)}" x2="${px(c)}" y1="16" y2="${p.height}" stroke="var(--ink)" stroke-width="1.5"/><rect x="${px(c - 20)}" y="0" width="40" height="17" rx="5" fill="var(--ink)"/><text x="${px(c)}" y="12.500" text-anchor="middle" style="fill:var(--on)">${p.cursor}</text></g>`,
  );
  return `<svg width="${p.width}" height="${p.height}" viewBox="0 0 ${p.width} ${p.height}" role="group" aria-label="Contact labels, frames ${p.first} to ${p.last}">${out.join("")}</svg>`;
}

function trackSvg(p: DeskPicture, t: number, x: ReturnType<typeof deskScale>): string {
  const y = trackTop(t);
  const side = t < 2 ? "left" : "right";
  const letter = t < 2 ? "L" : "R";
  const heel = t % 2 === 0;
  const right = p.width - 8;
  const at = p.track === t;
  const out = [
    `<g data-track="${t}" role="button" tabindex="-1" aria-label="${TRACK_NAMES[t]}" aria-pressed="${at}">`,
    at
      ? `<rect x="0" y="${y - 2}" width="${p.width}" height="${TRACK + 4}" rx="5" fill="var(--chosen)"/>`
      : "",
    `<rect x="${DESK_LEFT}" y="${y}" width="${right - DESK_LEFT}" height="${TRACK}" rx="4" fill="var(--well)"/>`,
    `<rect x="8" y="${y + 5}" width="16" height="16" rx="4" fill="var(--${side})"/><text x="16" y="${y + 17}" text-anchor="middle" style="fill:var(--paper);font-weight:600">${letter}</text>`,
    `<text x="32" y="${y + 17}" style="fill:var(--ink)${at ? ";font-weight:600" : ""}">${heel ? "Heel" : "Toe"}</text>`,
  ];
  for (const r of p.tracks[t]) {
    const a = x(r.from);
    const w = Math.max(2, x(r.to) - a);
    const unsure = r.sure !== null && r.sure < 0.9;
    const held = at && p.cursor >= r.from && p.cursor < r.to;
    out.push(
      `<rect data-run data-from="${r.from}" data-to="${r.to}" x="${px(a)}" y="${y}" width="${px(w)}" height="${TRACK}" rx="4" fill="var(--${side})" ${unsure ? `fill-opacity=".35" stroke="var(--${side})" stroke-width="1.5" stroke-dasharray="4 3"` : ""}${held ? ' stroke="var(--ink)" stroke-width="2"' : ""}><title>${TRACK_NAMES[t]}, frames ${r.from} to ${r.to - 1}${unsure ? `, ${(r.sure as number).toFixed(2)} sure` : ""}</title></rect>`,
    );
    if (heel && !unsure && w > 14)
      out.push(
        `<line x1="${px(a + 6)}" x2="${px(a + w - 6)}" y1="${y + TRACK - 6}" y2="${y + TRACK - 6}" stroke="var(--paper)" stroke-width="2" stroke-dasharray="1.500 3.500" stroke-linecap="round" pointer-events="none"/>`,
      );
    if (unsure && w > 62)
      out.push(
        `<text x="${px(a + w - 6)}" y="${y + 17}" text-anchor="end" style="fill:var(--ink)" pointer-events="none">${(r.sure as number).toFixed(2)} sure</text>`,
      );
    for (const [edge, at2] of [
      [r.from, a],
      [r.to, a + w],
    ])
      out.push(
        `<rect data-edge="${edge}" x="${px(at2 - EDGE)}" y="${y}" width="${2 * EDGE}" height="${TRACK}" fill="transparent" style="cursor:ew-resize"/>`,
      );
  }
  out.push("</g>");
  return out.join("");
}

function curvesSvg(
  p: DeskPicture,
  values: Float32Array,
  top: number,
  height: number,
  x: ReturnType<typeof deskScale>,
  name: string,
  unit: number,
  word: string,
): string {
  let most = 0;
  for (let i = 4 * p.first; i < 4 * p.last; i++) most = Math.max(most, values[i]);
  const y = scaleLinear([0, Math.max(1e-6, most)], [top + height - 2, top + 4]).clamp(true);
  const frames = Array.from({ length: p.last - p.first }, (_, k) => p.first + k);
  const out = [
    `<text x="8" y="${px(top + 14)}" style="fill:var(--ink)">${name}</text><text x="8" y="${px(top + 28)}">0 to ${(most * unit).toFixed(unit === 100 ? 0 : 1)} ${word}</text>`,
    `<line x1="${DESK_LEFT}" x2="${p.width - 8}" y1="${px(top + height - 2)}" y2="${px(top + height - 2)}" stroke="var(--line)"/>`,
  ];
  for (let t = 0; t < 4; t++) {
    const d = line<number>()
      .x((f) => x(f + 0.5))
      .y((f) => y(values[4 * f + t]))(frames);
    out.push(
      `<path d="${d ?? ""}" fill="none" stroke="var(--${t < 2 ? "left" : "right"})" stroke-width="1.4"${t % 2 ? ' stroke-dasharray="4 3"' : ""}/>`,
    );
  }
  return `<g pointer-events="none">${out.join("")}</g>`;
}
