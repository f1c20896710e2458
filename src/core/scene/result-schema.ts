/** Reading result documents: what `plan` wrote, or the editor; a mistake gives one sentence with its path. */
import * as v from "valibot";
import type { QualityFigures } from "../motion/types.ts";
import { FEET, PHASES, STEP_CATEGORIES } from "../steps/types.ts";
import { readJson } from "./json-text.ts";
import type { ResultDocument } from "./result.ts";
import { parseScene, SceneError } from "./schema.ts";
import { angle, faultOf, finite, id, list, object, oneOf, shown, within } from "./schema-parts.ts";
import type { Scene } from "./types.ts";

/** What is wrong with a result, and where: "footsteps[3].land: a number is needed, found \"late\"." */
export class ResultError extends Error {
  override name = "ResultError";
}

/** A result's times end within these seconds: four hours and a half, a million frames. */
const LONGEST = 16_666;
const MOST_FRAMES = 60 * LONGEST;
const time = within(0, LONGEST);
const text = (most: number) =>
  v.pipe(v.string("a text is needed"), v.maxLength(most, `at most ${most} characters are possible`));
// Wider than a scene's places: a step may overshoot its edge.
const far = within(-2000, 2000);
const bit = v.picklist([0, 1] as const, "0 or 1 is needed");
const figure = v.nullable(finite);

const footstep = object({
  foot: oneOf(FEET),
  position: v.tuple([far, far, far], "three numbers are needed"),
  yaw: angle,
  category: v.nullable(oneOf(STEP_CATEGORIES)),
  phase: v.nullable(oneOf(PHASES)),
  task: v.nullable(id),
  template: v.nullable(text(400)),
  lift: v.nullable(time),
  land: time,
});

const quality = object({
  skate: figure,
  skateFlat: figure,
  penetration: figure,
  float: figure,
  reach: figure,
  footstepError: v.nullable(object({ position: finite, yaw: finite })),
  limitViolations: finite,
  popping: figure,
  poppingOwn: figure,
  jerk: figure,
  balance: figure,
  balanceWithin50mm: figure,
  missedPlants: figure,
} satisfies Record<keyof QualityFigures, unknown>);

const document = object({
  version: v.literal(1, "version 1 is needed"),
  // By the scene's own schema.
  scene: v.unknown(),
  footsteps: list(footstep, 200_000),
  contacts: list(v.tuple([bit, bit, bit, bit], "four bits are needed"), MOST_FRAMES),
  timing: object({
    rate: v.literal(60, "60 is needed"),
    tasks: list(object({ id, start: time, contact: time, end: time }), 3000),
  }),
  quality,
  warnings: v.optional(list(text(2000), 5000), []),
});

/** The scene inside, its faults with their path from the result's top. */
function sceneOf(value: unknown): Scene {
  try {
    return parseScene(value);
  } catch (error) {
    const said = error instanceof Error ? error.message : String(error);
    throw new ResultError(said.startsWith("scene: ") ? said : `scene.${said}`);
  }
}

/** What no field shows by itself: parts that do not belong to each other. */
function checkWhole({ scene, footsteps, contacts, timing }: ResultDocument): void {
  FEET.forEach((foot, i) => {
    if (footsteps[i]?.foot !== foot || footsteps[i].lift !== null)
      throw new ResultError(`footsteps[${i}]: the ${foot} start stance, with lift null, is needed.`);
  });
  const order = new Set(scene.order);
  timing.tasks.forEach((t, i) => {
    const where = `timing.tasks[${i}]`;
    if (!order.has(t.id)) throw new ResultError(`${where}.id: the scene has no ${shown(t.id)}.`);
    if (!(t.start <= t.contact && t.contact <= t.end))
      throw new ResultError(
        `${where}: start, contact and end one after the other are needed, found ${t.start}, ${t.contact}, ${t.end}.`,
      );
  });
  const tasks = new Set(timing.tasks.map((t) => t.id));
  const seconds = contacts.length / timing.rate;
  for (let i = FEET.length; i < footsteps.length; i++) {
    const s = footsteps[i];
    for (const key of ["category", "phase", "lift"] as const)
      if (s[key] === null)
        throw new ResultError(`footsteps[${i}].${key}: only the two start stances have none, found null.`);
    if (s.lift !== null && s.lift > s.land)
      throw new ResultError(
        `footsteps[${i}].land: a time after its lift at ${s.lift} is needed, found ${s.land}.`,
      );
    // Contacts are counted in whole frames.
    if (s.land > seconds + 1 / timing.rate)
      throw new ResultError(
        `footsteps[${i}].land: contacts end at ${seconds.toFixed(2)}, before it lands at ${s.land}.`,
      );
    if (s.task !== null && !tasks.has(s.task))
      throw new ResultError(`footsteps[${i}].task: timing.tasks has no ${shown(s.task)}.`);
  }
}

/**
 * A result from parsed JSON.
 *
 * @throws ResultError with the path and what is needed there.
 *
 * @example
 * const result = parseResult(JSON.parse(text));
 * console.log(result.footsteps.length - 2, "steps");
 */
export function parseResult(value: unknown): ResultDocument {
  const result = v.safeParse(document, value, { abortEarly: true });
  if (!result.success) throw new ResultError(faultOf(result.issues[0], "result"));
  const parsed: ResultDocument = { ...result.output, scene: sceneOf(result.output.scene) };
  checkWhole(parsed);
  return parsed;
}

/** A result from JSON text. @throws ResultError "F: footsteps[3].land: ...", beginning with `name`. */
export function readResult(text: string, name: string): ResultDocument {
  try {
    return parseResult(readJson(text));
  } catch (error) {
    throw new ResultError(`${name}: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** Whether parsed JSON is meant as a result: it holds footsteps beside a scene. */
const isResult = (value: unknown): boolean =>
  typeof value === "object" && value !== null && "footsteps" in value && "scene" in value;

/**
 * The scene of a scene document or of a result document, for those who take either.
 *
 * @returns `result` is null for a scene.
 * @throws SceneError or ResultError, beginning with `name`.
 */
export function readSceneOrResult(
  text: string,
  name: string,
): { scene: Scene; result: ResultDocument | null } {
  try {
    const value = readJson(text);
    if (!isResult(value)) return { scene: parseScene(value), result: null };
    const result = parseResult(value);
    return { scene: result.scene, result };
  } catch (error) {
    const said = `${name}: ${error instanceof Error ? error.message : String(error)}`;
    throw error instanceof ResultError ? new ResultError(said) : new SceneError(said);
  }
}
