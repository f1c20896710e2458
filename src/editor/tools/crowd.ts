/** The crowd tool: areas to begin in, single walkers with their goals, walls, doors and pillars, drawn on the floor. */
import { html, svg, type TemplateResult } from "lit";
import {
  addDoor,
  addPillar,
  addRegion,
  addWalker,
  addWall,
  changeRegion,
  changeWalker,
} from "../../core/scene/crowd-commands.ts";
import type { Scene } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { type Ref, ref } from "../selection.ts";
import type { Gesture, Tool, ToolPointer } from "./tool.ts";

const icon = (body: TemplateResult): TemplateResult =>
  html`<svg viewBox="0 0 18 18" aria-hidden="true">${body}</svg>`;

export const CROWD_ICONS = {
  crowd: icon(
    svg`<circle cx="9" cy="5" r="2" /><path d="M5.500 15v-2.500a3.500 3.500 0 017 0V15" /><circle cx="3.500" cy="7" r="1.400" /><circle cx="14.500" cy="7" r="1.400" /><path d="M1.500 14v-1.500a2.200 2.200 0 012.500-2M16.500 14v-1.500a2.200 2.200 0 00-2.500-2" />`,
  ),
  area: icon(
    svg`<rect x="3" y="4" width="12" height="10" rx="1" stroke-dasharray="2.500 2" /><circle cx="9" cy="9" r="1.200" />`,
  ),
  walker: icon(svg`<circle cx="5" cy="12" r="2" /><path d="M7 10.500L14 5M10.500 5H14v3.500" />`),
  wall: icon(svg`<path d="M3 13L15 5" stroke-width="3" />`),
  door: icon(svg`<path d="M2 9h4.500M11.500 9H16" stroke-width="3" />`),
  pillar: icon(svg`<circle cx="9" cy="9" r="4" fill="currentColor" />`),
  goal: icon(svg`<circle cx="9" cy="9" r="5.500" /><circle cx="9" cy="9" r="1.500" fill="currentColor" />`),
};

/** Shorter drags are a click, metres. */
const CLICK = 0.25;
const far = (a: readonly [number, number], b: readonly [number, number]): number =>
  Math.hypot(a[0] - b[0], a[1] - b[1]);

/** A drag from a place to a place: `draw` makes the scene anew from the mark each time; null leaves it alone. */
function drag(
  e: Editor,
  p: ToolPointer,
  draw: (scene: Scene, from: [number, number], to: [number, number]) => { scene: Scene; made: Ref } | null,
): Gesture | null {
  const at = p.level(0);
  if (!at) return null;
  const from = e.snapped(at, p.event);
  const mark = e.store.getState().scene;
  let made: Ref | null = null;
  const put = (to: [number, number]): void => {
    const drawn = draw(mark, from, to);
    made = drawn?.made ?? null;
    e.edit(() => drawn?.scene ?? mark);
  };
  put(from);
  return {
    move(m) {
      const to = m.level(0);
      if (to) put(e.snapped(to, m.event));
    },
    up() {
      if (!made) return false;
      e.scene.select([made]);
      return true;
    },
  };
}

export const crowdTool: Tool = {
  id: "crowd",
  label: "Crowd",
  icon: CROWD_ICONS.crowd,
  key: "C",
  order: 40,
  cursor: "crosshair",
  enter: (e) => e.set({ tab: "crowd" }),
  choices: [
    { id: "area", label: "Area", icon: CROWD_ICONS.area, key: "A" },
    { id: "walker", label: "Walker", icon: CROWD_ICONS.walker, key: "G" },
    { id: "wall", label: "Wall", icon: CROWD_ICONS.wall, key: "E" },
    { id: "door", label: "Door", icon: CROWD_ICONS.door, key: "D" },
    { id: "pillar", label: "Pillar", icon: CROWD_ICONS.pillar, key: "U" },
  ],
  down(e, p) {
    switch (e.store.getState().choice ?? "area") {
      case "area":
        return drag(e, p, (scene, a, b) => {
          if (Math.abs(a[0] - b[0]) < CLICK || Math.abs(a[1] - b[1]) < CLICK) return null;
          const { scene: next, index } = addRegion(scene, a, b);
          return { scene: next, made: ref("crowd-region", String(index), index) };
        });
      case "walker":
        return drag(e, p, (scene, a, b) => {
          const goal: [number, number] = far(a, b) < CLICK ? [a[0], a[1] + 4] : b;
          const { scene: next, index } = addWalker(scene, a, goal);
          return { scene: next, made: ref("crowd-agent", String(index), index) };
        });
      case "wall":
        return drag(e, p, (scene, a, b) => {
          if (far(a, b) < CLICK) return null;
          const { scene: next, id } = addWall(scene, a, b);
          return { scene: next, made: ref("prop", id) };
        });
      case "pillar":
        return drag(e, p, (scene, _, b) => {
          const { scene: next, id } = addPillar(scene, b);
          return { scene: next, made: ref("prop", id) };
        });
      default: {
        const at = p.level(0);
        if (!at) return null;
        const mark = e.store.getState().scene;
        const cut = addDoor(mark, at);
        if (cut === mark) {
          e.say("A door is cut into a wall: click on one.", false);
          return null;
        }
        e.edit(() => cut);
        return { plain: true, move: () => undefined };
      }
    }
  },
};

/** Fields of what is selected changed in place. */
export const changeOf = {
  region: (e: Editor, i: number, change: Parameters<typeof changeRegion>[2]) =>
    e.edit((scene) => changeRegion(scene, i, change)),
  walker: (e: Editor, i: number, change: Parameters<typeof changeWalker>[2]) =>
    e.edit((scene) => changeWalker(scene, i, change)),
};
