/** The stones tool: a click puts a stone down, a drag moves it before it is let go; the tool stays for the next. */
import { html, svg } from "lit";
import { addStone, changeStone, nextFoot, placeStone, stoneHeight } from "../../core/scene/stone-commands.ts";
import type { Editor } from "../editor.ts";
import { onlyId, ref } from "../selection.ts";
import type { Tool, ToolPointer } from "./tool.ts";

export const STONE_ICON = html`<svg viewBox="0 0 18 18" aria-hidden="true">${svg`<ellipse cx="5.5" cy="12" rx="3.2" ry="2" /><ellipse cx="12.200" cy="8.500" rx="3" ry="1.800" /><ellipse cx="7" cy="4.500" rx="2.600" ry="1.500" />`}</svg>`;

/** The place on the ground under the pointer: a level found by turns. */
function onGround(e: Editor, p: ToolPointer): [number, number] | null {
  const { terrain } = e.store.getState().scene;
  let at = p.level(0);
  for (let k = 0; k < 5 && at; k++) at = p.level(stoneHeight(terrain, at[0], at[1]));
  return at;
}

export const stonesTool: Tool = {
  id: "stones",
  label: "Stones",
  icon: STONE_ICON,
  key: "S",
  order: 30,
  cursor: "crosshair",
  enter: (e) => e.set({ tab: "stones" }),
  down(e, p) {
    const at = onGround(e, p);
    if (!at) return null;
    let id: string | null = null;
    const put = (to: [number, number]) =>
      e.edit((scene) => {
        if (id === null) {
          const added = addStone(scene, to[0], to[1]);
          id = added.id;
          return added.scene;
        }
        const stone = scene.stones.find((s) => s.id === id);
        return stone ? placeStone(scene, stone.id, [to[0], stone.position[1], to[1]], stone.yaw) : scene;
      });
    put(at);
    return {
      move(m) {
        const to = onGround(e, m);
        if (to) put(to);
      },
      up() {
        if (id !== null) e.scene.select([ref("stone", id)]);
        return undefined;
      },
    };
  },
  keydown(e, ev) {
    if (ev.key.toLowerCase() !== "q") return false;
    const id = onlyId(e.store.getState().selection, "stone");
    const stone = e.store.getState().scene.stones.find((s) => s.id === id);
    if (!stone) return false;
    e.edit((scene) => changeStone(scene, stone.id, { foot: nextFoot(stone.foot) }));
    return true;
  },
};
