/** The timeline's tasks: a bar each while it is done, an arrow to the next. */
import { tasksSvg } from "../../plots/timeline-strip.ts";
import { crowdAlone } from "../crowd/crowd-session.ts";
import { TASK_SHAPES, TASK_WORDS } from "../icons.ts";
import { hasRef, ref } from "../selection.ts";
import type { Lane } from "./lane.ts";

export const taskLane: Lane = {
  id: "tasks",
  order: 10,
  // A scene of paths or stones alone has no use for an empty lane.
  shown: (e) => {
    const { scene } = e.store.getState();
    return (
      scene.tasks.length > 0 || (scene.paths.length === 0 && scene.stones.length === 0 && !crowdAlone(scene))
    );
  },
  height: () => 26,
  draw(e, frame) {
    const s = e.store.getState();
    return tasksSvg(
      (s.plan?.tasks ?? []).map((t) => {
        const task = s.scene.tasks.find((x) => x.id === t.id);
        return {
          id: t.id,
          word: task ? TASK_WORDS[task.category].split(" ")[0] : t.id,
          contact: t.contact,
          end: t.end,
          shape: task ? TASK_SHAPES[task.category] : "",
          selected: hasRef(s.selection, ref("task", t.id)),
        };
      }),
      frame.x,
    );
  },
  down(e, target) {
    const id = target.closest("[data-task]")?.getAttribute("data-task");
    if (!id) return null;
    e.scene.select([ref("task", id)]);
    return { plain: true, move: () => undefined };
  },
  keydown(e, target, ev) {
    const id = target.closest("[data-task]")?.getAttribute("data-task");
    if (!id || (ev.key !== "Enter" && ev.key !== " ")) return false;
    e.scene.select([ref("task", id)]);
    return true;
  },
};
