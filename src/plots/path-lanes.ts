/**
 * Lanes of a walk along a path [Express Figure 3]: styles with their blends, loops, speed, stride and lean over time. Pure data in,
 * SVG markup out; each lane's top is y = 0.
 */
import { extent } from "d3-array";
import { scaleLinear } from "d3-scale";
import { area, curveMonotoneX, line } from "d3-shape";
import { safe } from "./markup.ts";
import { type BandLook, patternSvg } from "./style-pattern.ts";
import { STRIP_LEFT, type TimeScale } from "./timeline-strip.ts";

const RATE = 60;
const px = (v: number): string => v.toFixed(1);
const name = (text: string, unit = ""): string =>
  `<text x="0" y="14" style="fill:var(--ink-2)">${safe(text)}</text>${unit ? `<text x="0" y="27" style="font-size:10px">${safe(unit)}</text>` : ""}`;

/** A stretch of time in one style, between its blends; seconds. */
export interface StyleStretch {
  from: number;
  to: number;
  style: string;
  look: BandLook;
  /** Which change of the scene begins it: path and place in its list; null for the beginning. */
  change: string | null;
  selected: boolean;
}

/** A blend between two stretches; seconds. */
export interface BlendBox {
  from: number;
  to: number;
  /** The change that it belongs to. */
  change: string;
  words: string;
}

const BAR = 30;
/** Width of a letter, about, pixels. */
const LETTER = 6.1;

/** Styles as bands, blends as crossed boxes with their lengths beneath, a handle where each change begins. */
export function stylesSvg(
  stretches: readonly StyleStretch[],
  blends: readonly BlendBox[],
  x: TimeScale,
): string {
  const out = [name("Style")];
  for (const s of stretches) {
    const a = x(s.from);
    const w = x(s.to) - a;
    if (w < 0.5) continue;
    const word = s.style[0].toUpperCase() + s.style.slice(1);
    const letters = Math.floor((w - 20) / LETTER);
    const shown = letters >= word.length ? word : `${word.slice(0, letters - 1)}…`;
    out.push(
      `<g role="button" tabindex="0" data-stretch="${safe(s.change ?? "start")}" aria-pressed="${s.selected}" aria-label="${safe(word)}, ${s.from.toFixed(2)} to ${s.to.toFixed(2)} s"><rect x="${px(a)}" y="2" width="${px(w)}" height="${BAR}" rx="4" fill="${s.look.colour}" stroke="var(--ink)" stroke-width="${s.selected ? 2 : 0}"/>${patternSvg(s.look, a + 4, 2, w - 8, BAR)}${
        letters >= 3
          ? `<rect x="${px(a + 4)}" y="7" width="${px(LETTER * shown.length + 12)}" height="20" rx="5" fill="var(--paper)"/><text x="${px(a + 10)}" y="21" style="fill:var(--ink);font-size:12px">${safe(shown)}</text>`
          : ""
      }</g>`,
    );
  }
  for (const b of blends) {
    const a = x(b.from);
    const w = Math.max(4, x(b.to) - a);
    out.push(
      `<g data-change="${safe(b.change)}" style="cursor:ew-resize"><rect x="${px(a)}" y="2" width="${px(w)}" height="${BAR}" fill="var(--paper)" stroke="var(--ink)" stroke-dasharray="2 2"/><path d="M${px(a)} 2l${px(w)} ${BAR}M${px(a)} ${BAR + 2}l${px(w)} -${BAR}" stroke="var(--ink)" stroke-width="0.8"/><text x="${px(a + w / 2)}" y="44" text-anchor="middle">${(b.to - b.from).toFixed(1)} s</text></g>`,
    );
    out.push(
      `<g role="slider" tabindex="0" data-change="${safe(b.change)}" aria-label="${safe(b.words)}" aria-valuenow="${b.from.toFixed(2)}" aria-valuetext="begins at ${b.from.toFixed(2)} s, takes ${(b.to - b.from).toFixed(2)} s" style="cursor:ew-resize"><rect x="${px(a - 8)}" y="0" width="16" height="${BAR + 4}" fill="transparent"/><rect x="${px(a - 3)}" y="7" width="6" height="20" rx="2" fill="var(--paper)" stroke="var(--ink)" stroke-width="1.5"/></g>`,
    );
  }
  return out.join("");
}

/** One pass of each loop as a box with an arch; `starts` are frames. */
export function loopsSvg(starts: readonly number[], frames: number, x: TimeScale, height: number): string {
  const h = Math.max(10, height - 6);
  const boxes = starts.map((from, i) => {
    const a = x(from / RATE) + 0.8;
    const w = x((starts[i + 1] ?? frames) / RATE) - a - 0.8;
    if (w < 2) return "";
    return `<rect x="${px(a)}" y="2" width="${px(w)}" height="${px(h)}" rx="4" fill="var(--well)"/>${w > 12 ? `<path d="M${px(a + 4)} ${px(h - 2)}q${px(w / 2 - 4)} ${px(-h * 0.9)} ${px(w - 8)} 0" fill="none" stroke="var(--ink-3)"/>` : ""}`;
  });
  return name("Loops") + boxes.join("");
}

export interface TrackLane {
  title: string;
  unit: string;
  /** A value a frame. */
  values: Float32Array;
  /** Range of the lane; what is shown may leave it. */
  range: [number, number];
  /** How a value is written. */
  write(v: number): string;
}

/** Every so many frames a point, so that long walks stay light. */
const MOST_POINTS = 400;

/** A value over time as a curve, its least and largest value written at the right ends of two hairlines. */
export function trackSvg(d: TrackLane, x: TimeScale, height: number): string {
  const n = d.values.length;
  const every = Math.max(1, Math.ceil(n / MOST_POINTS));
  const frames: number[] = [];
  for (let f = 0; f < n; f += every) frames.push(f);
  const [low = 0, high = 1] = extent(d.values);
  const y = scaleLinear([Math.min(d.range[0], low), Math.max(d.range[1], high)], [height - 7, 5]);
  const path = line<number>(
    (f) => x(f / RATE),
    (f) => y(d.values[f]),
  ).curve(curveMonotoneX)(frames);
  return `<g role="img" aria-label="${safe(`${d.title}: ${d.write(low)} to ${d.write(high)}`)}">${name(d.title, d.unit)}<line x1="${STRIP_LEFT}" x2="${px(x(n / RATE))}" y1="${px(height - 0.5)}" y2="${px(height - 0.5)}" stroke="var(--line)"/><path d="${path ?? ""}" fill="none" stroke="var(--ink)" stroke-width="1.4"/></g>`;
}

/** Lean to the path's left (up) and right (down) as a filled curve about the upright; `values` in degrees a frame. */
export function leanSvg(values: Float32Array, x: TimeScale, height: number): string {
  const n = values.length;
  const every = Math.max(1, Math.ceil(n / MOST_POINTS));
  const frames: number[] = [];
  for (let f = 0; f < n; f += every) frames.push(f);
  const [low = 0, high = 0] = extent(values);
  const most = Math.max(5, Math.abs(low), Math.abs(high));
  const y = scaleLinear([-most, most], [height - 2, 2]);
  const shape = area<number>(
    (f) => x(f / RATE),
    () => y(0),
    (f) => y(values[f]),
  ).curve(curveMonotoneX)(frames);
  return `<g role="img" aria-label="Lean: ${(-low).toFixed(1)} degrees to the right, ${high.toFixed(1)} to the left at most">${name("Lean")}<line x1="${STRIP_LEFT}" x2="${px(x(n / RATE))}" y1="${px(y(0))}" y2="${px(y(0))}" stroke="var(--edge)" stroke-width="0.8"/><path d="${shape ?? ""}" fill="var(--ink-2)"/></g>`;
}
