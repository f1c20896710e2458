/** Transport and strips under the viewport. */
import { html, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { stripScale, timelineStrip } from "../../plots/timeline-strip.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import { ICONS, TASK_WORDS } from "../icons.ts";

const SPEEDS: [number, string][] = [
  [0.25, "¼"],
  [0.5, "½"],
  [1, "1×"],
  [2, "2×"],
];

const clock = (t: number): string => t.toFixed(2).padStart(5, "0");

export function timeline(e: Editor): TemplateResult {
  const s = e.store.getState();
  const duration = e.duration();
  return html`
    <div class="transport">
      <button class="play" aria-label=${s.playing ? "Pause" : "Play"} title="Space" @click=${() => e.togglePlay()}>${s.playing ? ICONS.pause : ICONS.play}</button>
      <button class="icon" aria-label="Frame back" @click=${() => e.stepFrame(-1)}>${ICONS.back}</button>
      <button class="icon" aria-label="Frame ahead" @click=${() => e.stepFrame(1)}>${ICONS.ahead}</button>
      <button class="icon" aria-label="Loop" aria-pressed=${s.loop} @click=${() => e.toggleLoop()}>${ICONS.loop}</button>
      <span class="clock">${clock(s.time)} <span>/ ${clock(duration)} s</span></span>
      <div class="segments" role="group" aria-label="Speed">${SPEEDS.map(([v, label]) => html`<button aria-pressed=${s.speed === v} @click=${() => e.setSpeed(v)}>${label}</button>`)}</div>
      <span style="flex: 1"></span>
      <button class="icon" aria-label="Frame the scene" title="Frame the scene (F)" @click=${() => e.frameScene()}>${ICONS.frame}</button>
    </div>
    <div class="tracks" @pointerdown=${(ev: PointerEvent) => scrub(e, ev)} @pointermove=${(ev: PointerEvent) => hover(e, ev)} @pointerleave=${() => e.hoverStep(-1)} @keydown=${(ev: KeyboardEvent) => key(e, ev)}>
      ${unsafeSVG(strip(e, duration))}
    </div>
  `;
}

function strip(e: Editor, duration: number): string {
  const s = e.store.getState();
  const { width, height } = e.tracksSize;
  const motion = e.motion.current;
  return timelineStrip(
    {
      duration,
      time: s.time,
      contacts: motion ? motion.contacts.subarray(0, motion.filled) : new Uint8Array(0),
      steps: (s.plan?.steps ?? []).map((p, index) => ({
        foot: p.foot,
        category: p.category,
        lift: p.lift,
        land: p.land,
        index,
      })),
      tasks: (s.plan?.tasks ?? []).map((t) => {
        const task = s.scene.tasks.find((x) => x.id === t.id);
        return {
          id: t.id,
          word: task ? TASK_WORDS[task.category].split(" ")[0] : t.id,
          contact: t.contact,
          end: t.end,
          selected: t.id === s.selected,
        };
      }),
      colours: CATEGORY_COLOURS,
      words: CATEGORY_WORDS,
      hover: s.hoverStep,
    },
    width,
    height,
  );
}

function scrub(e: Editor, ev: PointerEvent): void {
  const target = (ev.target as Element).closest("[data-task]");
  if (target) {
    e.select(target.getAttribute("data-task"), true);
    return;
  }
  const box = ev.currentTarget as HTMLElement;
  const left = box.getBoundingClientRect().left;
  const to = (x: number) => e.seek(stripScale(e.duration(), e.tracksSize.width).invert(x - left));
  to(ev.clientX);
  box.setPointerCapture(ev.pointerId);
  const move = (m: PointerEvent) => to(m.clientX);
  box.addEventListener("pointermove", move);
  box.addEventListener("pointerup", () => box.removeEventListener("pointermove", move), { once: true });
  box.addEventListener("pointercancel", () => box.removeEventListener("pointermove", move), { once: true });
}

function hover(e: Editor, ev: PointerEvent): void {
  const step = (ev.target as Element).closest("[data-step]");
  e.hoverStep(step ? Number(step.getAttribute("data-step")) : -1);
}

function key(e: Editor, ev: KeyboardEvent): void {
  const task = (ev.target as Element).closest("[data-task]");
  if (task && (ev.key === "Enter" || ev.key === " ")) {
    ev.preventDefault();
    e.select(task.getAttribute("data-task"), true);
  }
}
