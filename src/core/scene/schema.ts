/**
 * Reading scene documents: every field but `version` may be left out; a mistake gives one sentence with its path. Each field of a thing
 * also says how it is called and in what unit people read it: `fields.ts` lists them for inspectors.
 */
import * as v from "valibot";
import { FEET } from "../steps/types.ts";
import { readJson } from "./json-text.ts";
import {
  angle,
  faultOf,
  id,
  list,
  object,
  oneOf,
  place,
  point2,
  point3,
  positive,
  shown,
  within,
} from "./schema-parts.ts";
import { TASK_CATEGORIES } from "./task-types.ts";
import { CROWD_GAITS, PLANT_MODES, PROP_KINDS, PROP_SIZES, type Scene } from "./types.ts";

/** What is wrong with a document, and where: "tasks[2].yaw: a number is needed, found \"left\"." */
export class SceneError extends Error {
  override name = "SceneError";
}

/** What a field is to people: its name, the unit it is shown in, names of its parts or choices. */
export interface FieldAbout {
  label: string;
  /** "°" of an angle in radians; the rest as they are. */
  unit?: "m" | "°" | "s" | "m/s";
  /** Names of the numbers of a tuple. */
  axes?: readonly string[];
  /** Words of choices, by value. */
  words?: Readonly<Record<string, string>>;
  /** Kinds or categories of things for which it means something; left out: all. */
  only?: readonly string[];
  /** Least and most of a slider that changes it; left out: a field. */
  slider?: readonly [number, number];
}
const about = <S extends v.BaseSchema<unknown, unknown, v.BaseIssue<unknown>>>(schema: S, a: FieldAbout) =>
  v.pipe(schema, v.metadata({ ...a }));

const FOOT_WORDS = { left: "Left", right: "Right" };
const facing = about(v.optional(angle, 0), { label: "Facing", unit: "°" });
const position = about(point3, { label: "Position", unit: "m", axes: ["x", "y", "z"] });
const factor = (label: string) => about(v.optional(within(0.7, 1.4), 1), { label, slider: [0.85, 1.15] });

const task = object({
  id,
  category: oneOf(TASK_CATEGORIES),
  position,
  yaw: facing,
  effort: about(v.optional(v.picklist([0, 1] as const, "0 or 1 is needed"), 1), {
    label: "Effort",
    words: { 0: "Low", 1: "High" },
    only: ["write"],
  }),
  hand: about(v.optional(oneOf(["left", "right"]), "right"), {
    label: "Hand",
    words: FOOT_WORDS,
    only: ["write"],
  }),
  duration: about(v.optional(v.nullable(within(0, 600)), null), {
    label: "Hold",
    unit: "s",
    only: TASK_CATEGORIES.filter((c) => c !== "turn"),
  }),
});

const path = object({
  id,
  points: list(point2, 5000),
  styles: v.optional(list(object({ at: within(0, 1), style: id }), 200), []),
  smooth: v.optional(v.boolean("true or false is needed"), true),
});

const stone = object({
  id,
  position: point3,
  yaw: v.optional(angle, 0),
  foot: v.optional(v.nullable(oneOf(FEET)), null),
  time: v.optional(v.nullable(within(0, 3600)), null),
});

const prop = object({
  id,
  kind: oneOf(PROP_KINDS),
  position,
  yaw: facing,
  size: about(
    v.optional(v.nullable(v.tuple([positive, positive, positive], "three numbers are needed")), null),
    { label: "Size", unit: "m", axes: ["w", "h", "d"] },
  ),
});

const terrain = v.variant(
  "kind",
  [
    object({ kind: v.literal("flat") }),
    object({ kind: v.literal("slope"), angle: within(-0.7, 0.7), yaw: v.optional(angle, 0) }),
    object({
      kind: v.literal("heightfield"),
      size: v.tuple([positive, positive], "two numbers are needed"),
      cells: v.tuple(
        [
          v.pipe(within(1, 512), v.integer("a whole number is needed")),
          v.pipe(within(1, 512), v.integer("a whole number is needed")),
        ],
        "two numbers are needed",
      ),
      heights: list(within(-20, 20), 263169),
    }),
  ],
  "kind flat, slope or heightfield is needed",
);

const goals = list(point2, 100);
const bounds = v.tuple([place, place, place, place], "four numbers are needed");
const crowd = object({
  agents: v.optional(
    list(
      object({
        position: point2,
        yaw: v.optional(angle, 0),
        goals,
        speed: v.optional(within(0.05, 5), 1.3),
        gait: v.optional(oneOf(CROWD_GAITS), "usual"),
      }),
      5000,
    ),
    [],
  ),
  regions: v.optional(
    list(
      object({
        bounds,
        count: v.pipe(within(0, 5000), v.integer("a whole number is needed")),
        goals,
        speed: v.optional(within(0.05, 5), 1.3),
        gait: v.optional(oneOf(CROWD_GAITS), "usual"),
      }),
      100,
    ),
    [],
  ),
  surfaces: v.optional(list(object({ bounds, cost: within(1, 20) }), 100), []),
});

const edit = object({
  task: v.optional(v.nullable(id), null),
  step: v.pipe(within(0, 100000), v.integer("a whole number is needed")),
  foot: v.optional(v.nullable(oneOf(FEET)), null),
  position: about(v.optional(v.nullable(point3), null), {
    label: "Position",
    unit: "m",
    axes: ["x", "y", "z"],
  }),
  yaw: about(v.optional(v.nullable(angle), null), { label: "Facing", unit: "°" }),
  lift: v.optional(v.nullable(within(0, 3600)), null),
  land: v.optional(v.nullable(within(0, 3600)), null),
  rest: about(v.optional(v.nullable(within(0.02, 3600)), null), { label: "On the floor", unit: "s" }),
  pinned: about(v.optional(v.boolean("true or false is needed"), false), { label: "Pinned" }),
  plant: about(v.optional(oneOf(PLANT_MODES), "auto"), {
    label: "Plant",
    words: { auto: "Auto", enforce: "Enforce", never: "Never" },
  }),
});

const proportions = object({ leg: factor("Legs"), arm: factor("Arms"), torso: factor("Torso") });
const character = object({
  height: about(v.optional(within(1.2, 2.3), 1.75), { label: "Height", unit: "m", slider: [1.5, 2] }),
  proportions: v.optional(proportions, {}),
  model: v.optional(v.nullable(v.string("a text is needed")), null),
});

/** Schemas of the things that inspectors show. */
export const THING_SCHEMAS = { task, prop, edit, character, proportions };

const document = object({
  version: v.literal(1, "version 1 is needed"),
  seed: v.optional(v.pipe(within(0, 4294967295), v.integer("a whole number is needed")), 1),
  character: v.optional(character, {}),
  start: v.optional(object({ position: v.optional(point2, [0, 0]), yaw: v.optional(angle, 0) }), {}),
  tasks: v.optional(list(task, 500), []),
  paths: v.optional(list(path, 100), []),
  stones: v.optional(list(stone, 2000), []),
  order: v.optional(list(id, 3000)),
  props: v.optional(list(prop, 2000), []),
  terrain: v.optional(terrain, { kind: "flat" }),
  crowd: v.optional(v.nullable(crowd), null),
  edits: v.optional(list(edit, 5000), []),
});

/**
 * A scene from parsed JSON, every default filled in.
 *
 * @throws SceneError with the path and what is needed there.
 */
export function parseScene(value: unknown): Scene {
  const result = v.safeParse(document, value, { abortEarly: true });
  if (!result.success) throw new SceneError(faultOf(result.issues[0], "scene"));
  const d = result.output;
  const ids = [...d.tasks, ...d.paths, ...d.stones].map((x) => x.id);
  const seen = new Set<string>();
  for (const [name, items] of [
    ["tasks", d.tasks],
    ["paths", d.paths],
    ["stones", d.stones],
    ["props", d.props],
  ] as const) {
    items.forEach((item, i) => {
      const key = name === "props" ? `prop ${item.id}` : item.id;
      if (seen.has(key))
        throw new SceneError(`${name}[${i}].id: an id of its own is needed, found ${shown(item.id)} again.`);
      seen.add(key);
    });
  }
  const order = d.order ?? ids;
  order.forEach((x, i) => {
    if (!ids.includes(x)) throw new SceneError(`order[${i}]: no task, path or stone has the id ${shown(x)}.`);
    if (order.indexOf(x) !== i)
      throw new SceneError(`order[${i}]: each id is named once, found ${shown(x)} again.`);
  });
  if (d.terrain.kind === "heightfield") {
    const wanted = (d.terrain.cells[0] + 1) * (d.terrain.cells[1] + 1);
    if (d.terrain.heights.length !== wanted)
      throw new SceneError(
        `terrain.heights: ${wanted} numbers are needed, found ${d.terrain.heights.length}.`,
      );
  }
  return {
    ...d,
    // Things that the order leaves out come last, in their own order.
    order: [...order, ...ids.filter((x) => !order.includes(x))],
    props: d.props.map((p) => ({ ...p, size: p.size ?? PROP_SIZES[p.kind] })),
  } as Scene;
}

/** A scene from JSON text. @throws SceneError "F: tasks[2].yaw: ...", beginning with `name`. */
export function readScene(text: string, name: string): Scene {
  try {
    return parseScene(readJson(text));
  } catch (error) {
    throw new SceneError(`${name}: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** The scene as JSON text, two spaces deep. */
export function serializeScene(scene: Scene): string {
  return `${JSON.stringify(scene, null, 2)}\n`;
}
