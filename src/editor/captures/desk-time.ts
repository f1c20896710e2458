/** The desk's lower half: transport and the four label tracks over the curves. */
import { html, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { contactTracks, type DeskRun, deskScale } from "../../plots/contact-tracks.ts";
import { ICONS } from "../icons.ts";
import type { Capture } from "./capture.ts";
import type { CaptureSession } from "./session.ts";

const SPEEDS: [number, string][] = [
  [0.25, "¼"],
  [0.5, "½"],
  [1, "1×"],
  [2, "2×"],
];

/** Size of the tracks' picture, pixels. */
export interface DeskSize {
  width: number;
  height: number;
}

export function deskTime(s: CaptureSession, size: DeskSize): TemplateResult {
  const c = s.current;
  if (!c) return html``;
  const { edits } = c;
  return html`
    <div class="transport">
      <button class="play" aria-label=${s.clock.playing ? "Pause" : "Play"} title="K" @click=${() => s.clock.toggle()}>${s.clock.playing ? ICONS.pause : ICONS.play}</button>
      <button class="icon" aria-label="Frame back" @click=${() => s.moveTo(edits.cursor - 1)}>${ICONS.back}</button>
      <button class="icon" aria-label="Frame ahead" @click=${() => s.moveTo(edits.cursor + 1)}>${ICONS.ahead}</button>
      <span class="clock">${edits.cursor} <span>/ ${edits.frames.toLocaleString("en")}</span></span>
      <div class="segments" role="group" aria-label="Speed">${SPEEDS.map(([v, label]) => html`<button aria-pressed=${s.clock.speed === v} @click=${() => s.clock.setSpeed(v)}>${label}</button>`)}</div>
      <span class="space"></span>
      <button class="icon" aria-label="Undo a label" ?disabled=${!edits.canUndo} @click=${() => s.step("undo")}>${ICONS.undo}</button>
      <button class="icon" aria-label="Redo a label" ?disabled=${!edits.canRedo} @click=${() => s.step("redo")}>${ICONS.redo}</button>
    </div>
    <div class="tracks desk-tracks" @pointerdown=${(ev: PointerEvent) => down(s, c, size, ev)}>
      ${unsafeSVG(
        contactTracks({
          ...size,
          first: s.stretch.first,
          last: s.stretch.last,
          cursor: edits.cursor,
          track: edits.track,
          brush: edits.brush !== null,
          tracks: [0, 1, 2, 3].map((t) => runsOf(s, c, t)),
          heights: c.curves.heights,
          speeds: c.curves.speeds,
        }),
      )}
    </div>
  `;
}

function runsOf(s: CaptureSession, c: Capture, track: number): DeskRun[] {
  return c.edits.runs(track, s.stretch.first, s.stretch.last).map(({ from, to }) => {
    let sure = 0;
    let confirmed = true;
    for (let f = from; f < to; f++) {
      const v = c.share[4 * f + track];
      sure += Math.max(v, 1 - v);
      if (!c.edits.confirmed[f]) confirmed = false;
    }
    return { from, to, sure: confirmed ? null : sure / (to - from) };
  });
}

/** On an edge it drags the edge; on a track it paints from there with the opposite; anywhere else it scrubs. */
function down(s: CaptureSession, c: Capture, size: DeskSize, ev: PointerEvent): void {
  if (ev.button !== 0) return;
  const host = ev.currentTarget as HTMLElement;
  const { left } = host.getBoundingClientRect();
  const x = deskScale({ first: s.stretch.first, last: s.stretch.last, width: size.width });
  const frameAt = (clientX: number): number => Math.floor(x.invert(clientX - left));
  const target = ev.target as Element;
  const track = target.closest("[data-track]")?.getAttribute("data-track");
  const edge = target.getAttribute("data-edge");
  const start = frameAt(ev.clientX);
  const { edits } = c;
  host.setPointerCapture(ev.pointerId);
  if (track !== null && track !== undefined) edits.pick(Number(track));
  let move: (clientX: number) => void;
  const onTrack = track !== null && track !== undefined;
  if (edge !== null && onTrack) {
    edits.begin();
    let at = Number(edge);
    move = (clientX) => {
      at = edits.moveEdge(edits.track, at, Math.round(x.invert(clientX - left)));
      edits.moveTo(at);
    };
  } else if (onTrack && ev.clientX - left >= x(s.stretch.first)) {
    const value = edits.at(edits.track, start) ? 0 : 1;
    let painting = false;
    // A click only goes there: a drag paints.
    move = (clientX) => {
      const to = frameAt(clientX);
      if (!painting && to === start) return;
      if (!painting) edits.begin();
      painting = true;
      edits.paint(edits.track, Math.min(start, to), Math.max(start, to) + 1, value);
      edits.moveTo(to);
    };
    s.moveTo(start);
  } else {
    move = (clientX) => s.moveTo(frameAt(clientX));
    move(ev.clientX);
  }
  const onMove = (m: PointerEvent): void => {
    move(m.clientX);
    s.edited();
  };
  const end = (kept: boolean) => (): void => {
    host.removeEventListener("pointermove", onMove);
    if (kept) edits.commit();
    else edits.cancel();
    s.edited();
  };
  host.addEventListener("pointermove", onMove);
  host.addEventListener("pointerup", end(true), { once: true });
  host.addEventListener("pointercancel", end(false), { once: true });
  s.edited();
}
