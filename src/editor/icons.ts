/** Pictograms, 18 px, drawn with strokes. */
import { html, svg, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import type { TaskCategory } from "../core/scene/task-types.ts";

const icon = (body: TemplateResult): TemplateResult =>
  html`<svg viewBox="0 0 18 18" aria-hidden="true">${body}</svg>`;

export const ICONS = {
  select: icon(svg`<path d="M4 3l9.5 4.6-4 1.5-1.6 4.2z" />`),
  task: icon(
    svg`<circle cx="6.500" cy="9" r="4" /><path d="M6.500 8.900v.2M13.500 6.200L17 9l-3.500 2.800z" fill="currentColor" />`,
  ),
  share: icon(svg`<path d="M9 11V2.500M6 5l3-3 3 3M4.500 9v6h9V9" />`),
  tick: icon(svg`<path d="M4 9.500l3.500 3.500L14 5.500" />`),
  warning: icon(svg`<path d="M9 3L2.500 14.500h13zM9 7.500v3.200M9 12.600v.1" />`),
  close: icon(svg`<path d="M5 5l8 8M13 5l-8 8" />`),
  more: icon(svg`<path d="M4 9h.1M9 9h.1M14 9h.1" stroke-width="2.500" />`),
  camera: icon(
    svg`<rect x="2.500" y="5" width="13" height="9.500" rx="2" /><circle cx="9" cy="9.700" r="2.600" /><path d="M6.500 5l1-2h3l1 2" />`,
  ),
  board: icon(
    svg`<rect x="3" y="3" width="12" height="8" rx="1" /><path d="M5.500 11v4.500M12.500 11v4.500" />`,
  ),
  table: icon(svg`<path d="M2.500 6h13M4 6v9M14 6v9" />`),
  stool: icon(svg`<path d="M5 5.500h8M6 5.500L4.500 15M12 5.500L13.500 15M5.300 11h7.400" />`),
  box: icon(svg`<path d="M3 6l6-3 6 3v6.500l-6 3-6-3zM3 6l6 3 6-3M9 9v6.500" />`),
  wall: icon(svg`<path d="M2.500 4.500h13v9h-13zM2.500 9h13M9 4.500V9M6 9v4.500M12 9v4.500" />`),
  pillar: icon(svg`<path d="M4 3h10M4 15h10M6 3v12M12 3v12" />`),
  foot: icon(
    svg`<path d="M6.500 9.500C5 5 6.500 2 9 2s4 3 2.800 7.500zM6.800 11.500h5c.300 2.500-.500 4.500-2.500 4.500s-2.800-2-2.500-4.500z" />`,
  ),
  snap: icon(
    svg`<path d="M4.500 15V9a4.500 4.500 0 019 0v6h-3V9a1.500 1.500 0 00-3 0v6zM4.500 12h3M10.500 12h3" />`,
  ),
  path: icon(
    svg`<path d="M4 15c0-5 9-3 9-8 0-2-1.600-3-3.500-3" /><circle cx="4" cy="15" r="1.200" /><circle cx="9" cy="4" r="1.200" />`,
  ),
  undo: icon(svg`<path d="M6 4L3 7l3 3M3 7h7a4 4 0 010 8H7" />`),
  redo: icon(svg`<path d="M12 4l3 3-3 3M15 7H8a4 4 0 000 8h3" />`),
  light: icon(
    svg`<circle cx="9" cy="9" r="3" /><path d="M9 2v1.5M9 14.5V16M2 9h1.5M14.5 9H16M4 4l1 1M13 13l1 1M14 4l-1 1M5 13l-1 1" />`,
  ),
  dark: icon(svg`<path d="M15 10.5A6.5 6.5 0 017.5 3a6.5 6.5 0 107.5 7.5z" />`),
  help: icon(
    svg`<circle cx="9" cy="9" r="6.5" /><path d="M7.2 7.2a1.9 1.9 0 113 1.5c-.8.5-1.2.8-1.2 1.6M9 12.6v.1" />`,
  ),
  play: html`<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M4 2.5v11l9-5.5z" /></svg>`,
  pause: html`<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M4 3h3v10H4zM9 3h3v10H9z" /></svg>`,
  first: icon(svg`<path d="M12 4v10L6 9zM4.5 4v10" fill="currentColor" />`),
  back: icon(svg`<path d="M10.5 4v10l-6-5zM13.5 4v10" fill="currentColor" />`),
  ahead: icon(svg`<path d="M7.5 4v10l6-5zM4.500 4v10" fill="currentColor" />`),
  loop: icon(svg`<path d="M4 8V7a3 3 0 013-3h7m-2-2l2 2-2 2M14 10v1a3 3 0 01-3 3H4m2 2l-2-2 2-2" />`),
  frame: icon(svg`<path d="M3 6V3h3M12 3h3v3M15 12v3h-3M6 15H3v-3" />`),
  chevron: icon(svg`<path d="M5.5 7.5L9 11l3.5-3.5" />`),
  copy: icon(
    svg`<rect x="6" y="6" width="9" height="9" rx="2" /><path d="M12 6V5a2 2 0 00-2-2H5a2 2 0 00-2 2v5a2 2 0 002 2h1" />`,
  ),
};

/** Inside of each category's pictogram, 18 x 18. */
export const TASK_SHAPES: Record<TaskCategory, string> = {
  write: '<path d="M11.5 3.5l3 3L6.5 14.5 3 15l.5-3.5zM10 5l3 3"/>',
  lift: '<rect x="4.5" y="9" width="9" height="6" rx="1"/><path d="M9 7V2M6.5 4.5L9 2l2.5 2.5"/>',
  place: '<path d="M3 15h12M5 12h8V9.5M9 2v5M6.5 5L9 7.5 11.5 5M5 12V9.5"/>',
  sit: '<path d="M5 3v7h7v5M5 15v-5M12 10l2 5"/>',
  stand: '<circle cx="9" cy="3.6" r="1.6"/><path d="M9 6v5M6 8h6M9 11l-2.5 5M9 11l2.5 5"/>',
  turn: '<path d="M14 9a5 5 0 11-2-4M12.5 2v3.5H9"/>',
};

const taskIcon = (c: TaskCategory): TemplateResult =>
  html`<svg viewBox="0 0 18 18" aria-hidden="true">${unsafeSVG(TASK_SHAPES[c])}</svg>`;

export const TASK_ICONS: Record<TaskCategory, TemplateResult> = {
  write: taskIcon("write"),
  lift: taskIcon("lift"),
  place: taskIcon("place"),
  sit: taskIcon("sit"),
  stand: taskIcon("stand"),
  turn: taskIcon("turn"),
};

export const TASK_WORDS: Record<TaskCategory, string> = {
  write: "Write",
  lift: "Lift the box",
  place: "Place the box",
  sit: "Sit",
  stand: "Stand",
  turn: "Turn around",
};
