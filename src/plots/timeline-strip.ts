/** Parts of the timeline, pure data in, SVG out: ruler, tasks, the feet's strips, the playhead. Each lane's top is y = 0. */
import { scaleLinear } from "d3-scale";
import type { Foot, StepCategory } from "../core/steps/types.ts";
import { safe } from "./markup.ts";

/** Pixels at the left for the lanes' names. */
export const STRIP_LEFT = 58;
/** Height of the ruler above the lanes, pixels. */
export const RULER = 18;

/** Seconds to pixels. */
export type TimeScale = (seconds: number) => number;

const px = (v: number): string => v.toFixed(1);

/** Time to pixels of a timeline `width` wide, and back with `invert`. */
export function stripScale(duration: number, width: number) {
  return scaleLinear([0, Math.max(0.1, duration)], [STRIP_LEFT, width - 4]).clamp(true);
}

/** Half the width of the playhead's flag, pixels. */
const FLAG = 20;

/** Seconds along the top, with a line down through all lanes; none is written where the playhead's flag stands. */
export function rulerSvg(duration: number, x: TimeScale, height: number, time: number): string {
  const every = [0.5, 1, 2, 5, 10, 20, 60].find((s) => x(s) - x(0) > 44) ?? 120;
  const out: string[] = [];
  for (let t = 0; t <= duration + 1e-6; t += every) {
    const from = x(t) + 3;
    const text = `${t} s`;
    const covered = from < x(time) + FLAG && from + 6 * text.length > x(time) - FLAG;
    out.push(
      `<line x1="${px(x(t))}" x2="${px(x(t))}" y1="16" y2="${height}" stroke="var(--line)"/>${covered ? "" : `<text x="${px(from)}" y="11">${text}</text>`}`,
    );
  }
  return out.join("");
}

export interface TaskBar {
  id: string;
  word: string;
  /** Seconds. */
  contact: number;
  end: number;
  selected: boolean;
  /** Markup of its pictogram, 18 x 18, drawn with strokes; "" for none. */
  shape: string;
}

/** Tasks as bars, arrows from one to the next. */
export function tasksSvg(tasks: readonly TaskBar[], x: TimeScale): string {
  const out = [`<text x="0" y="16">Tasks</text>`];
  tasks.forEach((t, i) => {
    const a = x(t.contact);
    const w = Math.max(24, x(t.end) - a);
    const next = tasks[i + 1];
    const ink = t.selected ? "var(--on)" : "var(--ink)";
    if (next && x(next.contact) - (a + w) > 18) {
      const to = x(next.contact) - 5;
      out.push(
        `<path d="M${px(a + w + 5)} 12.500H${px(to)}M${px(to - 4)} 9.500l4 3-4 3" fill="none" stroke="var(--ink-4)"/>`,
      );
    }
    out.push(
      `<g role="button" tabindex="0" data-task="${safe(t.id)}" aria-label="${safe(t.word)}, ${t.contact.toFixed(2)} to ${t.end.toFixed(2)} s"><rect x="${px(a)}" y="2" width="${px(w)}" height="21" rx="6" fill="${t.selected ? "var(--ink)" : "var(--well)"}"/>${w > 22 && t.shape ? `<g transform="translate(${px(a + 5)} 5.500) scale(0.8)" fill="none" stroke="${ink}" stroke-width="1.7" stroke-linecap="round" stroke-linejoin="round">${t.shape}</g>` : ""}${w > 58 ? `<text x="${px(a + 24)}" y="16.500" style="fill:${ink};font-weight:500;font-size:12px">${safe(t.word)}</text>` : ""}</g>`,
    );
  });
  return out.join("");
}

export interface StripStep {
  foot: Foot;
  category: StepCategory;
  /** Seconds. */
  lift: number;
  land: number;
  /** Index in the plan. */
  index: number;
  /** What the user asks of the plant that it begins; left out: as the capture has it. */
  plant?: "enforce" | "never" | undefined;
}

export interface FeetData {
  /** Seconds. */
  time: number;
  /** Contact bits a frame at 60 Hz; may be shorter than the motion while it arrives. */
  contacts: Uint8Array;
  steps: readonly StripStep[];
  colours: Record<StepCategory, { fill: string; mark: string; code: string }>;
  words: Record<StepCategory, string>;
  /** Index of the step under the pointer, -1 for none. */
  hover: number;
  /** Indices of the steps that are selected. */
  selected: readonly number[];
}

/** For each foot a toe bar over a heel bar, coloured by the step that brought the foot there. */
export function feetSvg(d: FeetData, x: TimeScale, height: number): string {
  const out: string[] = [];
  const bar = Math.max(8, Math.min(13, (height - 12) / 4 - 3));
  (["left", "right"] as const).forEach((foot, side) => {
    const top = 4 + side * (2 * bar + 10);
    out.push(
      `<rect x="0" y="${px(top + bar - 8)}" width="16" height="16" rx="4" fill="var(--${foot})"/><text x="8" y="${px(top + bar + 4)}" text-anchor="middle" style="fill:var(--on);font-weight:600">${side === 0 ? "L" : "R"}</text><text x="24" y="${px(top + bar - 2)}">toe</text><text x="24" y="${px(top + 2 * bar + 1)}">heel</text>`,
    );
    const own = d.steps.filter((s) => s.foot === foot);
    for (const [row, bit] of [
      [0, 2 * side + 1],
      [1, 2 * side],
    ] as const)
      out.push(...plants(d, own, bit, row, top + row * (bar + 2), bar, x));
    out.push(...unheld(d, own, top, bar, x));
  });
  return out.join("");
}

/** Plants that claim no contact, outlined from landing to lift: they can be selected and given back. */
function unheld(d: FeetData, own: readonly StripStep[], top: number, bar: number, x: TimeScale): string[] {
  return own.flatMap((s, i) => {
    if (s.plant !== "never") return [];
    const a = x(s.land);
    const w = Math.max(4, x(own[i + 1]?.lift ?? d.contacts.length / 60) - a);
    const chosen = s.index === d.hover || d.selected.includes(s.index);
    return [
      `<g role="button" tabindex="-1" data-step="${s.index}" aria-label="${s.foot === "left" ? "Left" : "Right"}, ${d.words[s.category].toLowerCase()}, never planted, ${s.lift.toFixed(2)} to ${s.land.toFixed(2)} s"><rect x="${px(a)}" y="${px(top)}" width="${px(w)}" height="${px(2 * bar + 2)}" rx="4" fill="transparent" stroke="${chosen ? "var(--ink)" : d.colours[s.category].fill}" stroke-width="${chosen ? 2 : 1.2}" stroke-dasharray="3 2"/></g>`,
    ];
  });
}

/** One bar a plant of one contact bit; it takes the colour of the step that led to it. */
function plants(
  d: FeetData,
  own: readonly StripStep[],
  bit: number,
  row: number,
  top: number,
  bar: number,
  x: TimeScale,
): string[] {
  const out: string[] = [];
  let from = -1;
  for (let f = 0; f <= d.contacts.length; f++) {
    const on = f < d.contacts.length && ((d.contacts[f] >> bit) & 1) === 1;
    if (on && from < 0) from = f;
    if (on || from < 0) continue;
    const a = x(from / 60);
    const w = Math.max(1, x(f / 60) - a - 0.8);
    const middle = (from + f) / 120;
    let step: StripStep | null = null;
    for (const s of own) if (s.land <= middle + 0.02) step = s;
    const c = step ? d.colours[step.category] : { fill: "var(--well)", mark: "var(--ink-3)", code: "" };
    const past = f / 60 < d.time;
    const named =
      row === 0 && step
        ? `role="button" tabindex="-1" data-step="${step.index}" aria-label="${step.foot === "left" ? "Left" : "Right"}, ${d.words[step.category].toLowerCase()}, ${step.lift.toFixed(2)} to ${step.land.toFixed(2)} s"`
        : "";
    const following = step ? own[own.indexOf(step) + 1] : undefined;
    const hovered = step !== null && (step.index === d.hover || d.selected.includes(step.index));
    // The landing's edge is caught within 8 pixels, and drawn for what is selected.
    const edge =
      step && Math.abs(step.land - from / 60) < 0.2
        ? `<rect data-edge="${step.index}" x="${px(a - 8)}" y="${px(top)}" width="14" height="${px(bar)}" fill="transparent" style="cursor:ew-resize"/>`
        : "";
    // So is the lift's, where the foot steps on.
    const lifts =
      step && following && Math.abs(following.lift - f / 60) < 0.2
        ? `<rect data-lift="${step.index}" x="${px(a + w - Math.min(6, w / 3))}" y="${px(top)}" width="${px(8 + Math.min(6, w / 3))}" height="${px(bar)}" fill="transparent" style="cursor:ew-resize"/>`
        : "";
    const chosen = step !== null && d.selected.includes(step.index);
    const handles = chosen
      ? [edge === "" ? null : a, lifts === "" ? null : a + w].flatMap((at) =>
          at === null
            ? []
            : [
                `<rect x="${px(at - 3)}" y="${px(top - 1.5)}" width="6" height="${px(bar + 3)}" rx="3" fill="var(--paper)" stroke="var(--ink)" stroke-width="1.5" pointer-events="none"/>`,
              ],
        )
      : [];
    // A plant that is enforced is underlined with ink.
    const forced =
      step?.plant === "enforce"
        ? `<line x1="${px(a + 2)}" x2="${px(a + w - 2)}" y1="${px(top + bar - 1.5)}" y2="${px(top + bar - 1.5)}" stroke="var(--ink)" stroke-width="2"/>`
        : "";
    out.push(
      `<g ${named} opacity="${past ? 0.45 : 1}"><rect x="${px(a)}" y="${px(top)}" width="${px(w)}" height="${px(bar)}" rx="4" fill="${c.fill}" stroke="${hovered ? "var(--ink)" : "color-mix(in srgb, var(--ink) 55%, transparent)"}" stroke-width="${hovered ? 2 : 0.8}"/>${row === 0 && w >= 22 && step ? `<text class="bar-text" x="${px(a + w / 2)}" y="${px(top + bar - 3)}" text-anchor="middle" style="fill:${c.mark}">${c.code}</text>` : ""}${forced}${edge}${lifts}${handles.join("")}</g>`,
    );
    from = -1;
  }
  return out;
}

/** What is now: a line through all lanes with the time on a flag. */
export function playheadSvg(time: number, x: TimeScale, height: number): string {
  const at = px(x(time));
  return `<g pointer-events="none"><line x1="${at}" x2="${at}" y1="14" y2="${height}" stroke="var(--paper)" stroke-width="4"/><line x1="${at}" x2="${at}" y1="8" y2="${height}" stroke="var(--ink)" stroke-width="1.5"/><rect x="${px(x(time) - FLAG)}" y="-3" width="${2 * FLAG}" height="17" rx="5" fill="var(--ink)"/><text x="${at}" y="10" text-anchor="middle" style="fill:var(--on);font-weight:600">${time.toFixed(2)}</text></g>`;
}
