/** Parts of a scene carried to another place or scene: what a clipboard holds. */
import { propsOfTask } from "./props.ts";
import { parseScene } from "./schema.ts";
import type { Scene, ScenePath, SceneProp, SceneStone, SceneTask } from "./types.ts";

/** Plain data, recognised by its first field. */
export interface Fragment {
  stepwright: 1;
  tasks: SceneTask[];
  paths: ScenePath[];
  stones: SceneStone[];
  props: SceneProp[];
}

/** The named things of a scene; tasks bring their furniture along. Unknown ids are left out. */
export function copyThings(scene: Scene, ids: ReadonlySet<string>): Fragment {
  const tasks = scene.order.flatMap((id) => scene.tasks.find((t) => t.id === id && ids.has(id)) ?? []);
  const furniture = new Set(tasks.flatMap((t) => propsOfTask(scene, t).map((p) => p.id)));
  return {
    stepwright: 1,
    tasks,
    paths: scene.paths.filter((p) => ids.has(p.id)),
    stones: scene.stones.filter((s) => ids.has(s.id)),
    props: scene.props.filter((p) => ids.has(p.id) || furniture.has(p.id)),
  };
}

/** The fragment of a text; null when the text is something else. @throws SceneError when it is a fragment with a mistake. */
export function readFragment(text: string): Fragment | null {
  let value: Partial<Fragment> | null;
  try {
    value = JSON.parse(text) as Partial<Fragment> | null;
  } catch {
    return null;
  }
  if (value === null || typeof value !== "object" || value.stepwright !== 1) return null;
  const { tasks = [], paths = [], stones = [], props = [] } = value;
  const checked = parseScene({ version: 1, tasks, paths, stones, props });
  return {
    stepwright: 1,
    tasks: checked.tasks,
    paths: checked.paths,
    stones: checked.stones,
    props: checked.props,
  };
}

/** What was put into a scene, by kind. */
export interface Pasted {
  scene: Scene;
  tasks: string[];
  paths: string[];
  stones: string[];
  props: string[];
}

/** A fragment put into a scene under ids of its own, moved by metres on the ground; last in the order. */
export function pasteThings(scene: Scene, fragment: Fragment, dx: number, dz: number): Pasted {
  const taken = new Set([...scene.tasks, ...scene.paths, ...scene.stones, ...scene.props].map((x) => x.id));
  const fresh = (id: string): string => {
    const stem = id.replace(/-\d+$/, "").slice(0, 70);
    let out = stem;
    for (let n = 2; taken.has(out); n++) out = `${stem}-${n}`;
    taken.add(out);
    return out;
  };
  const moved = <T extends { id: string; position: [number, number, number] }>(x: T): T => ({
    ...x,
    id: fresh(x.id),
    position: [x.position[0] + dx, x.position[1], x.position[2] + dz],
  });
  const tasks = fragment.tasks.map(moved);
  const stones = fragment.stones.map(moved);
  const props = fragment.props.map(moved);
  const paths = fragment.paths.map((p) => ({
    ...p,
    id: fresh(p.id),
    points: p.points.map((q): [number, number] => [q[0] + dx, q[1] + dz]),
  }));
  const ids = (list: readonly { id: string }[]): string[] => list.map((x) => x.id);
  return {
    scene: {
      ...scene,
      tasks: [...scene.tasks, ...tasks],
      paths: [...scene.paths, ...paths],
      stones: [...scene.stones, ...stones],
      props: [...scene.props, ...props],
      order: [...scene.order, ...ids(tasks), ...ids(paths), ...ids(stones)],
    },
    tasks: ids(tasks),
    paths: ids(paths),
    stones: ids(stones),
    props: ids(props),
  };
}
