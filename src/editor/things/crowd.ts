/** Parts of a crowd as things: areas, walkers and goals (walls and pillars are furniture); and the walkers themselves, looked at but not moved. */
import {
  changeWalker,
  placeGoal,
  placeRegion,
  removeRegions,
  removeWalkers,
} from "../../core/scene/crowd-commands.ts";
import type { Editor } from "../editor.ts";
import { ref } from "../selection.ts";
import { CROWD_ICONS } from "../tools/crowd.ts";
import type { ThingKind } from "./thing.ts";

/** Handles of more walkers or goals than this would hide the crowd itself. */
const MOST_HANDLES = 24;
const working = (e: Editor): boolean => {
  const s = e.store.getState();
  return (
    s.scene.crowd !== null && (s.tool === "crowd" || s.selection.some((r) => r.kind.startsWith("crowd-")))
  );
};

export const regionThings: ThingKind = {
  kind: "crowd-region",
  title: "Crowd areas",
  noun: "area",
  order: 40,
  handle: "dot",
  hint: "Drag to move the area",
  tab: "crowd",
  shown: working,
  list: (e) =>
    (e.store.getState().scene.crowd?.regions ?? []).map((r, i) => ({
      ref: ref("crowd-region", String(i), i),
      label: `Area ${i + 1}`,
      fact: `${r.count} walkers`,
      icon: CROWD_ICONS.area,
      position: [(r.bounds[0] + r.bounds[1]) / 2, 0, (r.bounds[2] + r.bounds[3]) / 2],
      yaw: null,
    })),
  place: (scene, r, position) => placeRegion(scene, r.index, [position[0], position[2]]),
  remove: (scene, refs) =>
    removeRegions(
      scene,
      refs.map((r) => r.index),
    ),
};

export const agentThings: ThingKind = {
  kind: "crowd-agent",
  title: "Crowd walkers",
  noun: "walker",
  order: 41,
  handle: "dot",
  hint: "Drag to move where the walker begins",
  tab: "crowd",
  shown: working,
  list: (e) =>
    (e.store.getState().scene.crowd?.agents ?? []).slice(0, MOST_HANDLES).map((a, i) => ({
      ref: ref("crowd-agent", String(i), i),
      label: `Walker ${i + 1}`,
      fact: `${a.speed.toFixed(2)} m/s`,
      icon: CROWD_ICONS.walker,
      position: [a.position[0], 0, a.position[1]],
      yaw: null,
    })),
  place: (scene, r, position) => changeWalker(scene, r.index, { position: [position[0], position[2]] }),
  remove: (scene, refs) =>
    removeWalkers(
      scene,
      refs.map((r) => r.index),
    ),
};

export const goalThings: ThingKind = {
  kind: "crowd-goal",
  title: "Crowd goals",
  noun: "goal",
  order: 42,
  handle: "dot",
  hint: "Drag to move the goal, also while the crowd runs",
  tab: "crowd",
  listed: false,
  shown: working,
  list: (e) => {
    const { crowd } = e.store.getState().scene;
    if (!crowd) return [];
    const of = (kind: "a" | "r", goals: readonly (readonly [number, number])[], i: number) =>
      goals.map((g, k) => ({
        ref: ref("crowd-goal", `${kind}-${i}-${k}`, i),
        label: `Goal of ${kind === "a" ? "walker" : "area"} ${i + 1}`,
        icon: CROWD_ICONS.goal,
        position: [g[0], 0, g[1]] as const,
        yaw: null,
      }));
    return [
      ...crowd.regions.flatMap((r, i) => of("r", r.goals, i)),
      ...crowd.agents.slice(0, MOST_HANDLES).flatMap((a, i) => of("a", a.goals, i)),
    ].slice(0, 2 * MOST_HANDLES);
  },
  place(scene, r, position) {
    const [of, i, k] = r.id.split("-");
    return placeGoal(scene, of === "a" ? "a" : "r", Number(i), Number(k), [position[0], position[2]]);
  },
  // A walker without a goal would not walk: its goals stay.
  remove: (scene) => scene,
};

/** Those who walk now: picked in the stage, told about in the panel. */
export const walkerThings: ThingKind = {
  kind: "crowd-walker",
  title: "Walking",
  noun: "walker",
  order: 44,
  handle: "none",
  tab: "crowd",
  listed: false,
  list: () => [],
  place: (scene) => scene,
  remove: (scene) => scene,
};
