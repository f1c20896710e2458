/** Pictograms of the embed's buttons and task markers: strokes in a square of 18. */
import type { TaskCategory } from "../core/scene/task-types.ts";
import { svgEl } from "./dom.ts";

/** Circles are written as "cx cy r". */
interface Icon {
  path: string;
  circle?: string;
  fill?: boolean;
}

const ICONS = {
  play: { path: "M5 3.500v11l9-5.500z", fill: true },
  pause: { path: "M5 4h3v10H5zM10 4h3v10h-3z", fill: true },
  undo: { path: "M6 4L3 7l3 3M3 7h7a4 4 0 010 8H7" },
  steps: {
    path: "M5 3.200c1.400 0 2 1.400 1.800 3.200-.1 1.100-.5 1.800-1.800 1.800S3.300 7.500 3.200 6.400C3 4.600 3.600 3.200 5 3.200zM3.600 9.600h2.800c0 1.300-.4 2.200-1.400 2.200s-1.400-.9-1.400-2.200zM12.600 5.400c1.400 0 2 1.400 1.800 3.200-.1 1.100-.5 1.800-1.800 1.800s-1.700-.7-1.800-1.800c-.2-1.800.4-3.200 1.800-3.200zM11.200 11.800H14c0 1.300-.4 2.200-1.400 2.200s-1.400-.9-1.400-2.200z",
    fill: true,
  },
} satisfies Record<string, Icon>;

const TASKS: Record<TaskCategory, Icon> = {
  write: { path: "M11.500 3.500l3 3L6.500 14.500 3 15l.5-3.500zM10 5l3 3" },
  lift: {
    path: "M5.500 9h7a1 1 0 011 1v4a1 1 0 01-1 1h-7a1 1 0 01-1-1v-4a1 1 0 011-1zM9 7V2M6.500 4.500L9 2l2.500 2.500",
  },
  place: { path: "M3 15h12M5 12h8V9.500M9 2v5M6.500 5L9 7.500 11.500 5M5 12V9.500" },
  sit: { path: "M5 3v7h7v5M5 15v-5M12 10l2 5" },
  stand: { path: "M9 6v5M6 8h6M9 11l-2.500 5M9 11l2.500 5", circle: "9 3.600 1.600" },
  turn: { path: "M14 9a5 5 0 11-2-4M12.500 2v3.500H9" },
};

export const TASK_WORDS: Record<TaskCategory, string> = {
  write: "the writing",
  lift: "the box",
  place: "where the box goes",
  sit: "the seat",
  stand: "the standing place",
  turn: "the turning point",
};

function draw(icon: Icon): SVGSVGElement {
  const svg = svgEl("svg", {
    viewBox: "0 0 18 18",
    "aria-hidden": "true",
    class: icon.fill ? "solid" : null,
  });
  svg.append(svgEl("path", { d: icon.path }));
  if (icon.circle) {
    const [cx, cy, r] = icon.circle.split(" ");
    svg.append(svgEl("circle", { cx, cy, r }));
  }
  return svg;
}

export const icon = (name: keyof typeof ICONS): SVGSVGElement => draw(ICONS[name]);
export const taskIcon = (category: TaskCategory): SVGSVGElement => draw(TASKS[category]);
