/** What an editor does to a scene: pure functions, a new scene each. Moving a task moves its furniture. */
import { wrapAngle } from "../math/angle.ts";
import { toLocal, toWorld } from "../math/frame2.ts";
import { propsOfTask } from "./props.ts";
import type { TaskCategory } from "./task-types.ts";
import type { FootstepEdit, Scene, SceneProp, SceneTask } from "./types.ts";
import { PROP_SIZES } from "./types.ts";

/** A task with what stands under it moved rigidly to a place and yaw. Unknown ids change nothing. */
export function placeTask(
  scene: Scene,
  id: string,
  position: readonly [number, number, number],
  yaw: number,
): Scene {
  const task = scene.tasks.find((t) => t.id === id);
  if (!task) return scene;
  const mine = new Set(propsOfTask(scene, task).map((p) => p.id));
  const from = { x: task.position[0], z: task.position[2], yaw: task.yaw };
  const to = { x: position[0], z: position[2], yaw };
  const rise = position[1] - task.position[1];
  return {
    ...scene,
    tasks: scene.tasks.map((t) =>
      t.id === id ? { ...t, position: [position[0], position[1], position[2]], yaw: wrapAngle(yaw) } : t,
    ),
    props: scene.props.map((p) => {
      if (!mine.has(p.id)) return p;
      const at = toWorld(to, toLocal(from, { x: p.position[0], z: p.position[2], yaw: p.yaw }));
      // Tables and stools grow with what is done on them; boards and boxes rise.
      const grows = p.kind === "table" || p.kind === "stool";
      return {
        ...p,
        position: [at.x, p.position[1] + (grows ? 0 : rise), at.z],
        yaw: at.yaw,
        size: grows ? [p.size[0], Math.max(0.2, p.size[1] + rise), p.size[2]] : p.size,
      } as SceneProp;
    }),
  };
}

/** Fields of a task changed in place. */
export function changeTask(
  scene: Scene,
  id: string,
  change: Partial<Pick<SceneTask, "effort" | "duration" | "hand">>,
): Scene {
  return { ...scene, tasks: scene.tasks.map((t) => (t.id === id ? { ...t, ...change } : t)) };
}

/** A new id with a readable stem. */
export function freeId(scene: Scene, stem: string): string {
  const taken = new Set([...scene.tasks, ...scene.paths, ...scene.stones, ...scene.props].map((x) => x.id));
  if (!taken.has(stem)) return stem;
  let n = 2;
  while (taken.has(`${stem}-${n}`)) n++;
  return `${stem}-${n}`;
}

/** Heights at which tasks are put down when they are added, metres. */
const HEIGHTS: Record<TaskCategory, number> = {
  write: 1.4,
  lift: 0.88,
  place: 0.88,
  sit: 0.46,
  stand: 0,
  turn: 0,
};

/** Adds a task with its furniture at a ground place, last in the order. */
export function addTask(
  scene: Scene,
  category: TaskCategory,
  x: number,
  z: number,
  yaw: number,
): { scene: Scene; id: string } {
  const id = freeId(scene, category);
  const y = HEIGHTS[category];
  const task: SceneTask = {
    id,
    category,
    effort: 1,
    position: [x, y, z],
    yaw: wrapAngle(yaw),
    duration: null,
    hand: "right",
  };
  const frame = { x, z, yaw };
  const props: SceneProp[] = [];
  const add = (kind: SceneProp["kind"], height: number, ahead: number) => {
    const at = toWorld(frame, { x: 0, z: ahead, yaw: 0 });
    props.push({
      id: freeId({ ...scene, props: [...scene.props, ...props] }, kind),
      kind,
      position: [at.x, height, at.z],
      yaw: wrapAngle(yaw),
      size: [...PROP_SIZES[kind]],
    });
  };
  if (category === "write") add("board", 1.5, 0);
  if (category === "lift") {
    add("table", 0, 0.17);
    add("box", y, 0);
  }
  if (category === "place") add("table", 0, 0.17);
  if (category === "sit") add("stool", 0, 0);
  return {
    scene: {
      ...scene,
      tasks: [...scene.tasks, task],
      order: [...scene.order, id],
      props: [...scene.props, ...props],
    },
    id,
  };
}

/** A copy of a task and its furniture, half a metre to the side, right after it in the order. */
export function duplicateTask(scene: Scene, id: string): { scene: Scene; id: string } {
  const task = scene.tasks.find((t) => t.id === id);
  if (!task) return { scene, id };
  const at = toWorld({ x: task.position[0], z: task.position[2], yaw: task.yaw }, { x: 0.9, z: 0, yaw: 0 });
  const added = addTask(scene, task.category, at.x, at.z, task.yaw);
  const order = added.scene.order.filter((x) => x !== added.id);
  order.splice(order.indexOf(id) + 1, 0, added.id);
  const moved = placeTask({ ...added.scene, order }, added.id, [at.x, task.position[1], at.z], task.yaw);
  return {
    scene: changeTask(moved, added.id, { effort: task.effort, duration: task.duration, hand: task.hand }),
    id: added.id,
  };
}

/** A task and the furniture that only it uses taken away. */
export function removeTask(scene: Scene, id: string): Scene {
  const task = scene.tasks.find((t) => t.id === id);
  if (!task) return scene;
  const rest = {
    ...scene,
    tasks: scene.tasks.filter((t) => t.id !== id),
    order: scene.order.filter((x) => x !== id),
  };
  const used = new Set(rest.tasks.flatMap((t) => propsOfTask(rest, t).map((p) => p.id)));
  const mine = new Set(propsOfTask(scene, task).map((p) => p.id));
  return { ...rest, props: scene.props.filter((p) => !mine.has(p.id) || used.has(p.id)) };
}

/** Height and leg factor of the character. */
export function setCharacter(scene: Scene, height: number, leg: number): Scene {
  return {
    ...scene,
    character: { ...scene.character, height, proportions: { ...scene.character.proportions, leg } },
  };
}

/** The character's build changed: height, metres, and the factors of its proportions. */
export function changeBuild(
  scene: Scene,
  change: Partial<Pick<Scene["character"], "height" | "proportions">>,
): Scene {
  return { ...scene, character: { ...scene.character, ...change } };
}

/** The character's file by name; null for the plain one. */
export function setModel(scene: Scene, model: string | null): Scene {
  return { ...scene, character: { ...scene.character, model } };
}

/** Adds a path of two points at least, last in the order. */
export function addPath(
  scene: Scene,
  points: readonly (readonly [number, number])[],
): { scene: Scene; id: string } {
  const id = freeId(scene, "path");
  const path = { id, points: points.map((p): [number, number] => [p[0], p[1]]), styles: [], smooth: true };
  return { scene: { ...scene, paths: [...scene.paths, path], order: [...scene.order, id] }, id };
}

/** A path's points replaced. */
export function reshapePath(scene: Scene, id: string, points: readonly (readonly [number, number])[]): Scene {
  return {
    ...scene,
    paths: scene.paths.map((p) =>
      p.id === id ? { ...p, points: points.map((q): [number, number] => [q[0], q[1]]) } : p,
    ),
  };
}

/** The styles painted along a path replaced; kept in order of place. */
export function paintPath(scene: Scene, id: string, styles: readonly { at: number; style: string }[]): Scene {
  const sorted = [...styles].sort((a, b) => a.at - b.at);
  return { ...scene, paths: scene.paths.map((p) => (p.id === id ? { ...p, styles: sorted } : p)) };
}

/** Whether a path's points are joined by a smooth curve or by straight lines. */
export function smoothPath(scene: Scene, id: string, smooth: boolean): Scene {
  return { ...scene, paths: scene.paths.map((p) => (p.id === id ? { ...p, smooth } : p)) };
}

/** A path walked from its other end, each stretch in the style that it had. */
export function reversePath(scene: Scene, id: string): Scene {
  const paths = scene.paths.map((p) => {
    if (p.id !== id) return p;
    const spans = p.styles[0]?.at === 0 ? p.styles : [{ at: 0, style: "walking" }, ...p.styles];
    const styles = spans.map((s, i) => ({ at: 1 - (spans[i + 1]?.at ?? 1), style: s.style })).reverse();
    return { ...p, points: [...p.points].reverse(), styles };
  });
  return { ...scene, paths };
}

/** A path taken away. */
export function removePath(scene: Scene, id: string): Scene {
  return {
    ...scene,
    paths: scene.paths.filter((p) => p.id !== id),
    order: scene.order.filter((x) => x !== id),
  };
}

/** What the user asks of a planned footstep, laid over what was asked before; fields left out stay. */
export function editFootstep(
  scene: Scene,
  task: string | null,
  step: number,
  change: Partial<Omit<FootstepEdit, "task" | "step">>,
): Scene {
  const mine = (e: FootstepEdit): boolean => e.task === task && e.step === step;
  const before = scene.edits.find(mine) ?? {
    task,
    step,
    foot: null,
    position: null,
    yaw: null,
    lift: null,
    land: null,
    rest: null,
    pinned: false,
    plant: "auto" as const,
  };
  return { ...scene, edits: [...scene.edits.filter((e) => !mine(e)), { ...before, ...change }] };
}

/** Footsteps given back to the planner. */
export function releaseFootsteps(
  scene: Scene,
  steps: readonly { task: string | null; step: number }[],
): Scene {
  const edits = scene.edits.filter((e) => !steps.some((s) => s.task === e.task && s.step === e.step));
  return edits.length === scene.edits.length ? scene : { ...scene, edits };
}

/** Furniture changed in place: where it stands, which way, how large. */
export function changeProp(
  scene: Scene,
  id: string,
  change: Partial<Pick<SceneProp, "position" | "yaw" | "size">>,
): Scene {
  return { ...scene, props: scene.props.map((p) => (p.id === id ? { ...p, ...change } : p)) };
}

/** Furniture taken away. */
export function removeProps(scene: Scene, ids: readonly string[]): Scene {
  return { ...scene, props: scene.props.filter((p) => !ids.includes(p.id)) };
}
