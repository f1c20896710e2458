/** Transport, and under it the ruler with the lanes that the features registered. */
import { html, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { playheadSvg, RULER, rulerSvg, stripScale } from "../../plots/timeline-strip.ts";
import { crowdAlone, crowdSession } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import { pictureExport } from "../formats/picture.ts";
import { ICONS } from "../icons.ts";
import type { Lane, LaneFrame } from "../lanes/lane.ts";

const SPEEDS: [number, string][] = [
  [0.25, "¼"],
  [0.5, "½"],
  [1, "1×"],
  [2, "2×"],
];

export const speeds = (e: Editor): TemplateResult =>
  html`<div class="segments" role="group" aria-label="Speed">${SPEEDS.map(([v, label]) => html`<button aria-pressed=${e.store.getState().speed === v} @click=${() => e.playback.setSpeed(v)}>${label}</button>`)}</div>`;

const clock = (t: number): string => t.toFixed(2).padStart(5, "0");

/** A crowd has a clock of its own: it runs ahead, and begins again. */
function crowdTransport(e: Editor): TemplateResult {
  const crowd = crowdSession(e);
  return html`<div class="transport">
    <button class="play" aria-label=${crowd.running ? "Pause" : "Play"} title="Space" ?disabled=${!crowd.ready} @click=${() => e.playback.toggle()}>${crowd.running ? ICONS.pause : ICONS.play}</button>
    <button class="icon" aria-label="From the start" title="From the start" @click=${() => crowd.restart()}>${ICONS.first}</button>
    <span class="clock">${clock(crowd.seconds)} <span>s</span></span>
    <span class="space"></span>
    <span class="quiet">${e.store.getState().snap ? "Snap 5 cm" : ""}</span>
    ${viewButtons(e)}
  </div>`;
}

const viewButtons = (e: Editor): TemplateResult =>
  html`<button class="icon" aria-label="Fit the view" title="Fit the view (F)" @click=${() => e.frameScene()}>${ICONS.frame}</button>
      <button class="icon wide" aria-label="Picture of the room" title="Picture of the room" @click=${() => void e.files.save(pictureExport)}>${ICONS.camera}</button>`;

export function timeline(e: Editor): TemplateResult {
  const s = e.store.getState();
  if (crowdAlone(s.scene)) return crowdTransport(e);
  return html`
    <div class="transport">
      <button class="play" aria-label=${s.playing ? "Pause" : "Play"} title="Space" @click=${() => e.playback.toggle()}>${s.playing ? ICONS.pause : ICONS.play}</button>
      <button class="icon" aria-label="Frame back" title="Frame back (,)" @click=${() => e.playback.stepFrame(-1)}>${ICONS.back}</button>
      <button class="icon" aria-label="Frame ahead" title="Frame ahead (.)" @click=${() => e.playback.stepFrame(1)}>${ICONS.ahead}</button>
      <button class="icon" aria-label="Loop" title="Loop (O)" aria-pressed=${s.loop} @click=${() => e.playback.toggleLoop()}>${ICONS.loop}</button>
      <span class="clock">${clock(s.time)} <span>/ ${clock(e.plan.duration)} s</span></span>
      ${speeds(e)}
      <span class="space"></span>
      <span class="quiet">${s.snap ? "Snap 5 cm" : ""}</span>
      ${viewButtons(e)}
    </div>
    ${
      stands(e)
        ? html`<div class="tracks idle"><p class="note">Footsteps stand here once the scene has a task, a path or stones.</p></div>`
        : html`<div class="tracks" @pointerdown=${(ev: PointerEvent) => down(e, ev)} @pointermove=${(ev: PointerEvent) => hover(e, ev)} @pointerleave=${() => leave(e)} @keydown=${(ev: KeyboardEvent) => key(e, ev)}>
      ${unsafeSVG(tracks(e))}
    </div>`
    }
  `;
}

/** Whether the plan has no footstep: the character only stands. */
export const stands = (e: Editor): boolean => e.store.getState().plan?.steps.length === 0;

interface Placed {
  lane: Lane;
  top: number;
  frame: LaneFrame;
}

/** Least part of its height that a lane can be drawn in. */
const LEAST = 0.6;

/** The lanes with their places: what they wish for, less an even share of what is missing. */
export function placedLanes(e: Editor): Placed[] {
  const { width, height } = e.tracksSize;
  const scale = stripScale(e.plan.duration, width);
  const shown = e.registry.lanes.filter((l) => l.shown(e));
  const total = (list: readonly Lane[]): number => list.reduce((sum, l) => sum + l.height(e), 0);
  const room = height - RULER;
  // Lanes at half their height run into each other: what explains goes before what is edited.
  const lanes = total(shown) * LEAST > room ? shown.filter((l) => !l.spare) : shown;
  const wished = lanes.map((l) => l.height(e));
  const all = total(lanes);
  const share = Math.min(1, Math.max(0.5, room / Math.max(1, all)));
  let top = RULER;
  return lanes.map((lane, i) => {
    const frame: LaneFrame = {
      width,
      height: wished[i] * share,
      x: (t) => scale(t),
      seconds: (x) => scale.invert(x),
    };
    const placed = { lane, top, frame };
    top += frame.height;
    return placed;
  });
}

function tracks(e: Editor): string {
  const { time } = e.store.getState();
  const { width, height } = e.tracksSize;
  const scale = stripScale(e.plan.duration, width);
  const lanes = placedLanes(e).map(
    ({ lane, top, frame }) =>
      `<g data-lane="${lane.id}" transform="translate(0 ${top.toFixed(1)})">${lane.draw(e, frame)}</g>`,
  );
  return `<svg width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" role="group" aria-label="Footsteps over time">${rulerSvg(e.plan.duration, scale, height, time)}${lanes.join("")}${playheadSvg(time, scale, height)}</svg>`;
}

function laneOf(e: Editor, target: EventTarget | null): Placed | null {
  const id = (target as Element | null)?.closest("[data-lane]")?.getAttribute("data-lane");
  return placedLanes(e).find((p) => p.lane.id === id) ?? null;
}

function down(e: Editor, ev: PointerEvent): void {
  if (ev.button !== 0) return;
  const placed = laneOf(e, ev.target);
  const gesture = placed?.lane.down?.(e, ev.target as Element, placed.frame, ev);
  if (gesture) {
    e.tools.run(gesture, ev);
    return;
  }
  // Anywhere else scrubs.
  const { left } = (ev.currentTarget as HTMLElement).getBoundingClientRect();
  const to = (x: number) => e.playback.seek(stripScale(e.plan.duration, e.tracksSize.width).invert(x - left));
  const before = e.store.getState().time;
  to(ev.clientX);
  e.tools.run({ plain: true, move: (p) => to(p.event.clientX), cancel: () => e.playback.seek(before) }, ev);
}

let over: Lane | null = null;

function hover(e: Editor, ev: PointerEvent): void {
  const lane = laneOf(e, ev.target)?.lane ?? null;
  if (over && over !== lane) over.hover?.(e, null);
  over = lane;
  lane?.hover?.(e, ev.target as Element);
}

function leave(e: Editor): void {
  over?.hover?.(e, null);
  over = null;
}

function key(e: Editor, ev: KeyboardEvent): void {
  const lane = laneOf(e, ev.target)?.lane;
  if (!lane?.keydown?.(e, ev.target as Element, ev)) return;
  ev.preventDefault();
  ev.stopPropagation();
}
