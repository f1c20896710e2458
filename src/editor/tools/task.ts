/** The task tool: a click on the floor puts a task of the chosen category down with its furniture. */
import { addTask } from "../../core/scene/commands.ts";
import { TASK_CATEGORIES, type TaskCategory } from "../../core/scene/task-types.ts";
import { ICONS, TASK_ICONS, TASK_WORDS } from "../icons.ts";
import { ref } from "../selection.ts";
import type { Tool } from "./tool.ts";

export const taskTool: Tool = {
  id: "task",
  label: "Task",
  icon: ICONS.task,
  key: "T",
  order: 10,
  cursor: "crosshair",
  choices: TASK_CATEGORIES.map((c, i) => ({
    id: c,
    label: TASK_WORDS[c],
    short: TASK_WORDS[c].split(" ")[0],
    icon: TASK_ICONS[c],
    key: String(i + 1),
  })),
  down(e, p) {
    const at = p.level(0);
    if (!at) return null;
    const category = (e.store.getState().choice ?? "write") as TaskCategory;
    let id: string | null = null;
    const put = (to: [number, number]) =>
      e.edit((scene, c) => {
        if (id === null) {
          // Facing away from the viewer; one sits facing the viewer.
          const added = addTask(scene, category, to[0], to[1], category === "sit" ? Math.PI : 0);
          id = added.id;
          return added.scene;
        }
        const task = scene.tasks.find((t) => t.id === id);
        return task ? c.placeTask(scene, task.id, [to[0], task.position[1], to[1]], task.yaw) : scene;
      });
    let last = e.snapped(at);
    return {
      move(m) {
        const to = m.level(0);
        if (!to) return;
        last = e.snapped(to, m.event);
        put(last);
      },
      up() {
        put(last);
        if (id !== null) e.scene.select([ref("task", id)]);
        e.tools.use("select");
        return undefined;
      },
    };
  },
};
