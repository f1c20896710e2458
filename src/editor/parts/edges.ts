/**
 * The inner edges of panel and timeline: dragged, moved with the arrows, collapsed by a double click. On narrow windows the
 * panel is a sheet with three heights instead.
 */
import { html, nothing, render, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";

interface Edge {
  name: "panel" | "timeline";
  /** CSS variable on the page's grid, pixels. */
  variable: string;
  least: number;
  most: number;
  usual: number;
}

const EDGES: readonly Edge[] = [
  { name: "panel", variable: "--panel-width", least: 240, most: 520, usual: 304 },
  { name: "timeline", variable: "--timeline-height", least: 46, most: 480, usual: 204 },
];
/** Pixels an arrow key moves an edge. */
const KEY = 16;

const sizes = new Map<string, number>();
const app = (): HTMLElement => document.querySelector("#app") as HTMLElement;

function resize(e: Editor, edge: Edge, to: number): void {
  const size = to === 0 ? 0 : Math.max(edge.least, Math.min(edge.most, to));
  sizes.set(edge.name, size);
  app().style.setProperty(edge.variable, `${size}px`);
  e.redraw();
}

function separator(e: Editor, edge: Edge): TemplateResult {
  const size = sizes.get(edge.name) ?? edge.usual;
  const across = edge.name === "panel";
  const drag = (ev: PointerEvent): void => {
    if (ev.button !== 0) return;
    ev.preventDefault();
    e.tools.run(
      {
        plain: true,
        move: (p) =>
          resize(e, edge, size + (across ? ev.clientX - p.event.clientX : ev.clientY - p.event.clientY)),
        cancel: () => resize(e, edge, size),
      },
      ev,
    );
  };
  const key = (ev: KeyboardEvent): void => {
    const way = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[ev.key];
    if (ev.key === "Enter") resize(e, edge, size === 0 ? edge.usual : 0);
    else if (way) resize(e, edge, size + way * KEY);
    else return;
    ev.preventDefault();
    ev.stopPropagation();
  };
  return html`<div class="edge of-${edge.name}" role="separator" tabindex="0" aria-orientation=${across ? "vertical" : "horizontal"} aria-label="Size of the ${edge.name}" aria-valuenow=${Math.round(size)} aria-valuemin="0" aria-valuemax=${edge.most} title="Drag to resize, double-click to fold" @pointerdown=${drag} @keydown=${key} @dblclick=${() => resize(e, edge, size === 0 ? edge.usual : 0)}></div>`;
}

const SHEET = ["peek", "half", "full"] as const;
const SHEET_WORDS = { peek: "low", half: "half", full: "full" } as const;

function handle(e: Editor): TemplateResult {
  const { sheet } = e.store.getState();
  const at = SHEET.indexOf(sheet);
  const to = (i: number): void => e.set({ sheet: SHEET[Math.max(0, Math.min(2, i))] });
  const drag = (ev: PointerEvent): void => {
    if (ev.button !== 0) return;
    let moved = 0;
    e.tools.run(
      {
        plain: true,
        move: (p) => {
          moved = ev.clientY - p.event.clientY;
        },
        up: () => {
          to(Math.abs(moved) < 8 ? (at + 1) % 3 : at + Math.sign(moved) * (Math.abs(moved) > 220 ? 2 : 1));
          return true;
        },
      },
      ev,
    );
  };
  return html`<button class="sheet-handle" aria-label="Sheet: ${SHEET_WORDS[sheet]}. Press for the next height." @pointerdown=${drag} @keydown=${(
    ev: KeyboardEvent,
  ) => {
    if (ev.key === "Enter" || ev.key === " ") to((at + 1) % 3);
    else if (ev.key === "ArrowUp") to(at + 1);
    else if (ev.key === "ArrowDown") to(at - 1);
    else return;
    ev.preventDefault();
    ev.stopPropagation();
  }}></button>`;
}

/** Draws the edges of the layout that the window has. */
export function edges(e: Editor, place: HTMLElement): void {
  app().dataset.sheet = e.store.getState().sheet;
  render(window.innerWidth < 760 ? handle(e) : html`${EDGES.map((x) => separator(e, x))}${nothing}`, place);
}
