/** Furniture as things: picked in the room, moved and turned on its own, without the task that it serves. */

import { wrapAngle } from "../../core/math/angle.ts";
import { copyThings, pasteThings } from "../../core/scene/clipboard.ts";
import { changeProp, removeProps } from "../../core/scene/commands.ts";
import type { PropKind } from "../../core/scene/types.ts";
import { ICONS } from "../icons.ts";
import { ref } from "../selection.ts";
import type { ThingKind } from "./thing.ts";

export const PROP_WORDS: Record<PropKind, string> = {
  board: "Whiteboard",
  table: "Table",
  stool: "Stool",
  box: "Box",
  wall: "Wall",
  pillar: "Pillar",
};

export const propThings: ThingKind = {
  kind: "prop",
  title: "Furniture",
  noun: "Furniture",
  order: 60,
  handle: "selected",
  clickFirst: true,
  tab: "prop",
  hint: "Drag to move",
  list: (e) =>
    e.store.getState().scene.props.map((p) => ({
      ref: ref("prop", p.id),
      label: PROP_WORDS[p.kind],
      icon: ICONS[p.kind],
      position: p.position,
      yaw: p.yaw,
    })),
  place: (scene, r, position, yaw) =>
    changeProp(scene, r.id, {
      position: [position[0], position[1], position[2]],
      yaw: wrapAngle(yaw),
    }),
  remove: (scene, refs) =>
    removeProps(
      scene,
      refs.map((r) => r.id),
    ),
  duplicate(scene, refs) {
    const pasted = pasteThings(scene, copyThings(scene, new Set(refs.map((r) => r.id))), 0.9, 0);
    return { scene: pasted.scene, refs: pasted.props.map((id) => ref("prop", id)) };
  },
  grab: (e, r, p) => e.markers.drag(r, "move", p),
};
