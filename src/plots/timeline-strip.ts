/** Tasks, and for each foot a toe bar over a heel bar, coloured by the step that brought the foot there. Pure data in, SVG out. */
import { scaleLinear } from "d3-scale";
import type { StepCategory } from "../core/steps/types.ts";

export interface StripStep {
  foot: "left" | "right";
  category: StepCategory;
  lift: number;
  land: number;
  index: number;
}

export interface StripData {
  duration: number;
  time: number;
  /** Contact bits a frame at 60 Hz; may be shorter than the motion while it arrives. */
  contacts: Uint8Array;
  steps: readonly StripStep[];
  tasks: readonly { id: string; word: string; contact: number; end: number; selected: boolean }[];
  colours: Record<StepCategory, { fill: string; mark: string; code: string }>;
  words: Record<StepCategory, string>;
  hover: number;
}

export const STRIP_LEFT = 58;
const safe = (s: string): string => s.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Time to pixels of a strip `width` wide. */
export function stripScale(duration: number, width: number) {
  return scaleLinear([0, Math.max(0.1, duration)], [STRIP_LEFT, width - 4]).clamp(true);
}

/** SVG markup. */
export function timelineStrip(d: StripData, width: number, height: number): string {
  const x = stripScale(d.duration, width);
  const out: string[] = [];
  const bar = Math.max(8, Math.min(13, (height - 62) / 4 - 3));
  const y0 = 52;
  const every = [0.5, 1, 2, 5, 10, 20, 60].find((s) => x(s) - x(0) > 44) ?? 120;
  for (let t = 0; t <= d.duration + 1e-6; t += every) {
    out.push(
      `<line x1="${x(t).toFixed(1)}" x2="${x(t).toFixed(1)}" y1="16" y2="${height}" stroke="var(--line)"/><text x="${(x(t) + 3).toFixed(1)}" y="11">${t} s</text>`,
    );
  }
  out.push(`<text x="0" y="34">Tasks</text>`);
  d.tasks.forEach((t) => {
    const a = x(t.contact);
    const w = Math.max(10, x(t.end) - a);
    out.push(
      `<g role="button" tabindex="0" data-task="${safe(t.id)}" aria-label="${safe(t.word)}, ${t.contact.toFixed(2)} to ${t.end.toFixed(2)} s"><rect x="${a.toFixed(1)}" y="20" width="${w.toFixed(1)}" height="21" rx="6" fill="${t.selected ? "var(--ink)" : "var(--well)"}"/>${w > 46 ? `<text x="${(a + 8).toFixed(1)}" y="34" style="fill:${t.selected ? "var(--on)" : "var(--ink)"}">${safe(t.word)}</text>` : ""}</g>`,
    );
  });
  (["left", "right"] as const).forEach((foot, side) => {
    const top = y0 + side * (2 * bar + 12);
    out.push(
      `<rect x="0" y="${(top + bar - 8).toFixed(1)}" width="16" height="16" rx="4" fill="var(--${foot})"/><text x="8" y="${(top + bar + 4).toFixed(1)}" text-anchor="middle" style="fill:var(--on);font-weight:600">${side === 0 ? "L" : "R"}</text><text x="24" y="${(top + bar - 2).toFixed(1)}">toe</text><text x="24" y="${(top + 2 * bar + 1).toFixed(1)}">heel</text>`,
    );
    const own = d.steps.filter((s) => s.foot === foot);
    // A plant takes the colour of the step that led to it.
    for (const [row, bit] of [
      [0, 2 * side + 1],
      [1, 2 * side],
    ] as const) {
      let from = -1;
      for (let f = 0; f <= d.contacts.length; f++) {
        const on = f < d.contacts.length && ((d.contacts[f] >> bit) & 1) === 1;
        if (on && from < 0) from = f;
        if (!on && from >= 0) {
          const a = x(from / 60);
          const w = Math.max(1, x(f / 60) - a - 0.8);
          const middle = (from + f) / 120;
          let step: StripStep | null = null;
          for (const s of own) if (s.land <= middle + 0.02) step = s;
          const c = step ? d.colours[step.category] : { fill: "var(--well)", mark: "var(--ink-3)", code: "" };
          const past = f / 60 < d.time;
          const label = step
            ? `${foot === "left" ? "Left" : "Right"}, ${d.words[step.category].toLowerCase()}, ${step.lift.toFixed(2)} to ${step.land.toFixed(2)} s`
            : "";
          out.push(
            `<g ${row === 0 && step ? `role="button" tabindex="-1" data-step="${step.index}" aria-label="${label}"` : ""} opacity="${past ? 0.45 : 1}"><rect x="${a.toFixed(1)}" y="${(top + row * (bar + 2)).toFixed(1)}" width="${w.toFixed(1)}" height="${bar.toFixed(1)}" rx="4" fill="${c.fill}" stroke="${step && step.index === d.hover ? "var(--ink)" : "color-mix(in srgb, var(--ink) 55%, transparent)"}" stroke-width="${step && step.index === d.hover ? 2 : 0.8}"/>${row === 0 && w >= 22 && step ? `<text class="bar-text" x="${(a + w / 2).toFixed(1)}" y="${(top + bar - 3).toFixed(1)}" text-anchor="middle" style="fill:${c.mark}">${c.code}</text>` : ""}</g>`,
          );
          from = -1;
        }
      }
    }
  });
  const px = x(d.time);
  out.push(
    `<g pointer-events="none"><line x1="${px.toFixed(1)}" x2="${px.toFixed(1)}" y1="14" y2="${height}" stroke="var(--paper)" stroke-width="4"/><line x1="${px.toFixed(1)}" x2="${px.toFixed(1)}" y1="8" y2="${height}" stroke="var(--ink)" stroke-width="1.5"/><rect x="${(px - 20).toFixed(1)}" y="-3" width="40" height="17" rx="5" fill="var(--ink)"/><text x="${px.toFixed(1)}" y="10" text-anchor="middle" style="fill:var(--on);font-weight:600">${d.time.toFixed(2)}</text></g>`,
  );
  return `<svg width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" role="group" aria-label="Footsteps over time">${out.join("")}</svg>`;
}
