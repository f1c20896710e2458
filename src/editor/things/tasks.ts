/** Tasks as things: a ball over what is done, a tick towards the facing. */
import { duplicateTask, placeTask, removeTask } from "../../core/scene/commands.ts";
import { TASK_ICONS, TASK_WORDS } from "../icons.ts";
import { type Ref, ref } from "../selection.ts";
import type { ThingKind } from "./thing.ts";

export const taskThings: ThingKind = {
  kind: "task",
  title: "Tasks",
  noun: "Task",
  order: 10,
  handle: "ball",
  tab: "task",
  hint: "Drag to move",
  list(e) {
    const { scene, plan } = e.store.getState();
    return scene.order.flatMap((id) => {
      const t = scene.tasks.find((x) => x.id === id);
      if (!t) return [];
      const time = plan?.tasks.find((p) => p.id === id);
      return {
        ref: ref("task", id),
        label: TASK_WORDS[t.category],
        fact: time ? `${time.contact.toFixed(2)} s` : undefined,
        icon: TASK_ICONS[t.category],
        position: t.position,
        yaw: t.yaw,
      };
    });
  },
  place: (scene, r, position, yaw) => placeTask(scene, r.id, position, yaw),
  remove: (scene, refs) => refs.reduce((s, r) => removeTask(s, r.id), scene),
  duplicate(scene, refs) {
    let out = scene;
    const copies: Ref[] = [];
    for (const r of refs) {
      const copy = duplicateTask(out, r.id);
      out = copy.scene;
      copies.push(ref("task", copy.id));
    }
    return { scene: out, refs: copies };
  },
};
