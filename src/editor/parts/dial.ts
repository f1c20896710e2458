/** A facing as a dial, beside its number: dragged round its middle, one entry of the history. Keys have the number. */
import { html, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";

/** The arrow points where the thing faces as the scene is first seen: up is away from the viewer, +X on the left. */
export function dial(e: Editor, yaw: number, set: (yaw: number) => void): TemplateResult {
  const turn = (ev: PointerEvent): void => {
    if (ev.button !== 0) return;
    ev.preventDefault();
    const box = (ev.currentTarget as HTMLElement).getBoundingClientRect();
    const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
    const to = ({ clientX, clientY, shiftKey }: PointerEvent): void =>
      set(e.snappedYaw(Math.atan2(x - clientX, y - clientY), { shiftKey }));
    e.tools.run({ move: (p) => to(p.event) }, ev);
  };
  const degrees = ((-yaw * 180) / Math.PI).toFixed(1);
  return html`<span class="dial" title="Drag to turn; Shift turns freely" aria-hidden="true" @pointerdown=${turn}><svg viewBox="-12 -12 24 24"><circle r="11" /><g transform="rotate(${degrees})"><path d="M0 0V-5" /><path class="head" d="M-3.6-4.4 0-10.2 3.6-4.4Z" /></g></svg></span>`;
}
