/** Stones as things: a dot each with its facing; Q changes the foot, Page Up and Page Down lift. */
import { freeId } from "../../core/scene/commands.ts";
import { changeStone, nextFoot, placeStone, removeStones } from "../../core/scene/stone-commands.ts";
import type { Scene } from "../../core/scene/types.ts";
import { type Ref, ref } from "../selection.ts";
import { STONE_ICON } from "../tools/stones.ts";
import type { ThingKind } from "./thing.ts";

/** Metres that a key lifts a stone by, and a pixel of an upward drag. */
const LIFT = 0.05;
const PIXEL = 0.004;
const HIGHEST = 1.5;

function lifted(scene: Scene, id: string, by: number): Scene {
  const stone = scene.stones.find((s) => s.id === id);
  if (!stone) return scene;
  const [x, y, z] = stone.position;
  return changeStone(scene, id, { position: [x, Math.max(-HIGHEST, Math.min(HIGHEST, y + by)), z] });
}

export const stoneThings: ThingKind = {
  kind: "stone",
  title: "Stones",
  noun: "Stone",
  order: 30,
  handle: "dot",
  tab: "stones",
  // While stones are laid, a click beside one lays the next.
  shown: (e) => e.store.getState().tool !== "stones",
  hint: "Drag to move, Alt drag in the room to lift",
  list(e) {
    const { scene, plan } = e.store.getState();
    const first = plan?.blend?.first ?? 0;
    let k = 0;
    return scene.order.flatMap((id) => {
      const s = scene.stones.find((x) => x.id === id);
      if (!s) return [];
      const step = plan?.blend ? plan.steps[first + k] : undefined;
      k++;
      const foot = s.foot ?? step?.foot;
      return {
        ref: ref("stone", id),
        label: foot === "left" ? "Left foot" : foot === "right" ? "Right foot" : "Stone",
        fact: step ? `${step.land.toFixed(2)} s` : undefined,
        icon: STONE_ICON,
        position: s.position,
        yaw: s.yaw,
      };
    });
  },
  place: (scene, r, position, yaw) => placeStone(scene, r.id, position, yaw),
  remove: (scene, refs) =>
    removeStones(
      scene,
      refs.map((r) => r.id),
    ),
  duplicate(scene, refs) {
    let out = scene;
    const copies: Ref[] = [];
    for (const r of refs) {
      const s = scene.stones.find((x) => x.id === r.id);
      if (!s) continue;
      const id = freeId(out, "stone");
      const [x, y, z] = s.position;
      const copy = { ...s, id, position: [x + 0.3, y, z + 0.3] as [number, number, number] };
      out = { ...out, stones: [...out.stones, copy], order: [...out.order, id] };
      copies.push(ref("stone", id));
    }
    return { scene: out, refs: copies };
  },
  grab(e, r, p) {
    const stone = e.store.getState().scene.stones.find((s) => s.id === r.id);
    if (!stone) return null;
    const [x, y, z] = stone.position;
    const from = p.level(y);
    if (!from) return null;
    return {
      move(m) {
        if (m.event.altKey) {
          e.edit((scene) => changeStone(scene, r.id, { position: [x, y + PIXEL * (p.y - m.y), z] }));
          return;
        }
        const to = m.level(y);
        if (to) e.edit((s) => placeStone(s, r.id, [x + to[0] - from[0], y, z + to[1] - from[1]], stone.yaw));
      },
    };
  },
  keydown(e, r, ev) {
    const stone = e.store.getState().scene.stones.find((s) => s.id === r.id);
    if (!stone) return false;
    if (ev.key.toLowerCase() === "q")
      return e.edit((s) => changeStone(s, r.id, { foot: nextFoot(stone.foot) }));
    if (ev.key === "PageUp") return e.edit((s) => lifted(s, r.id, LIFT));
    if (ev.key === "PageDown") return e.edit((s) => lifted(s, r.id, -LIFT));
    return false;
  },
};
