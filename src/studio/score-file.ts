/**
 * Scores as text: one JSON page is one performance. The format is told in docs/studio.md; a mistake gives one sentence
 * with its path.
 */
import * as v from "valibot";
import { wrapAngle } from "../core/math/angle.ts";
import { pivotPlace } from "../core/motion/sole.ts";
import { readJson } from "../core/scene/json-text.ts";
import { TASK_CATEGORIES } from "../core/scene/task-types.ts";
import { createSkeleton, DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../core/skeleton/skeleton.ts";
import { FEET } from "../core/steps/types.ts";
import type { GaitShape } from "./gait-shape.ts";
import { BOUNCING, FITTED } from "./gait-shapes.ts";
import { PHRASE_PARTS } from "./layers/phrase.ts";
import {
  DEFAULT_PACE,
  LAYERS,
  NEUTRAL,
  type Score,
  type ScoreEvent,
  type ScoreStance,
  type ScoreStep,
  STEP_KINDS,
} from "./score.ts";

/** What is wrong with a score, and where: "steps[3].land: must come after lift, 2.4 s." */
export class ScoreError extends Error {
  override name = "ScoreError";
}

const finite = v.pipe(v.number("a number is needed"), v.finite("a finite number is needed"));
const within = (low: number, high: number) =>
  v.pipe(
    finite,
    v.minValue(low, `at least ${low} is needed`),
    v.maxValue(high, `at most ${high} is possible`),
  );
const place = within(-100, 100);
const angle = within(-100, 100);
/** Seconds; ten minutes are the longest capture. */
const time = within(0, 600);
const object = <E extends v.ObjectEntries>(entries: E) => v.strictObject(entries, "an object is needed");
const list = <S extends v.BaseSchema<unknown, unknown, v.BaseIssue<unknown>>>(item: S, most: number) =>
  v.pipe(v.array(item, "a list is needed"), v.maxLength(most, `at most ${most} entries are possible`));
const oneOf = <T extends string>(values: readonly [T, ...T[]]) =>
  v.picklist(values, `one of ${values.join(", ")} is needed`);
const stance = object({ x: place, z: place, yaw: v.optional(angle, 0) });
const point3 = v.tuple([place, place, place], "three numbers are needed");

/** Every number of a record optional, within a range around its default. */
const numbers = <T extends object>(defaults: T, low: number, high: number) =>
  object(
    Object.fromEntries(Object.keys(defaults).map((k) => [k, v.optional(within(low, high))])) as Record<
      keyof T & string,
      v.OptionalSchema<ReturnType<typeof within>, undefined>
    >,
  );

const task = object({
  category: oneOf(TASK_CATEGORIES),
  effort: v.optional(v.picklist([0, 1] as const, "0 or 1 is needed"), 1),
  position: point3,
  yaw: v.optional(angle, 0),
  start: time,
  contact: time,
  end: time,
  hand: v.optional(oneOf(["left", "right", "both"]), "both"),
});

const event = v.variant(
  "type",
  [
    object({
      type: v.literal("write"),
      task,
      strokes: v.optional(
        list(
          object({
            times: list(time, 10000),
            points: list(v.tuple([within(-2, 2), within(-2, 2)], "two numbers are needed"), 10000),
          }),
          1000,
        ),
        [],
      ),
    }),
    object({
      type: v.literal("lift"),
      task,
      mass: v.optional(within(0, 40), 10),
      size: v.optional(
        v.tuple([within(0.05, 1), within(0.05, 1), within(0.05, 1)], "three numbers are needed"),
        [0.36, 0.26, 0.28],
      ),
    }),
    object({ type: v.literal("place"), task }),
    object({ type: v.literal("sit"), task, rise: v.optional(v.nullable(time), null) }),
    object({ type: v.literal("note"), task }),
  ],
  "type write, lift, place, sit or note is needed",
);

/** Gaits by name, for an actor whose gait is not that of the pace's speed. */
const GAITS = {
  slow: FITTED.walks[0],
  comfortable: FITTED.walks[1],
  brisk: FITTED.walks[2],
  fast: FITTED.walks[3],
  bouncing: BOUNCING,
  jog: FITTED.runs[0],
  run: FITTED.runs[1],
  fastRun: FITTED.runs[2],
} as const satisfies Record<string, GaitShape>;
type GaitName = keyof typeof GAITS;
const GAIT_NAMES = Object.keys(GAITS) as GaitName[];
const GAIT_CHOICES: readonly [GaitName | "speed", ...(GaitName | "speed")[]] = ["speed", ...GAIT_NAMES];

const factor = v.optional(within(0.7, 1.4), 1);
const document = object({
  version: v.literal(1, "version 1 is needed"),
  name: v.pipe(
    v.string("a text is needed"),
    v.regex(/^[\w-]{1,60}$/, "1 to 60 letters, digits, - or _ are needed"),
  ),
  seed: v.optional(v.pipe(within(0, 4294967295), v.integer("a whole number is needed")), 1),
  actor: v.optional(
    object({
      height: v.optional(within(1.2, 2.3), REFERENCE_HEIGHT),
      proportions: v.optional(object({ leg: factor, arm: factor, torso: factor }), DEFAULT_PROPORTIONS),
      pace: v.optional(numbers(DEFAULT_PACE, 0, 3)),
      mood: v.optional(numbers(NEUTRAL, -120, 120)),
      phrase: v.optional(
        object({
          strides: v.pipe(within(1, 100), v.integer("a whole number is needed")),
          lines: list(
            object({
              part: oneOf(PHRASE_PARTS),
              times: within(0, 100),
              amount: within(-180, 180),
              at: within(-1, 1),
            }),
            100,
          ),
        }),
      ),
      gait: v.optional(oneOf(GAIT_CHOICES), "speed"),
    }),
    {},
  ),
  duration: v.optional(time),
  start: object({ left: stance, right: stance }),
  steps: v.optional(
    list(
      object({
        foot: oneOf(FEET),
        kind: oneOf(STEP_KINDS),
        lift: time,
        land: time,
        x: v.optional(place),
        z: v.optional(place),
        yaw: v.optional(angle, 0),
      }),
      5000,
    ),
    [],
  ),
  events: v.optional(list(event, 500), []),
  gaze: v.optional(list(object({ time, target: v.nullable(point3) }), 2000), []),
  without: v.optional(list(oneOf(LAYERS), LAYERS.length), []),
});

/** Seconds that a performance goes on after its last step or task, where its score does not say. */
const AFTER = 1.1;

/** A score from its JSON text. @throws ScoreError with one sentence that names the place. */
export function readScore(text: string): Score {
  let value: unknown;
  try {
    value = readJson(text);
  } catch (error) {
    throw new ScoreError(error instanceof Error ? error.message : String(error));
  }
  const result = v.safeParse(document, value, { abortEarly: true });
  if (!result.success) {
    const [issue] = result.issues;
    throw new ScoreError(`${v.getDotPath(issue)?.replace(/\.(\d+)/g, "[$1]") ?? "score"}: ${issue.message}.`);
  }
  const d = result.output;
  const { gait, pace, mood, phrase, ...body } = d.actor;
  const score: Score = {
    name: d.name,
    seed: d.seed,
    actor: {
      ...body,
      ...(pace ? { pace: defined(pace) } : {}),
      ...(mood ? { mood: defined(mood) } : {}),
      ...(phrase ? { phrase } : {}),
      ...(gait !== "speed" ? { shape: GAITS[gait] } : {}),
    },
    start: d.start,
    steps: [],
    events: d.events as ScoreEvent[],
    gaze: d.gaze,
    duration: 0,
    ...(d.without.length > 0 ? { without: d.without } : {}),
  };
  const shape = createSkeleton(body.height, body.proportions).foot;
  const feet: Record<"left" | "right", ScoreStance> = { ...d.start };
  const free = { left: 0, right: 0 };
  let before = 0;
  d.steps.forEach((s, i) => {
    const at = (field: string, says: string) => new ScoreError(`steps[${i}].${field}: ${says}.`);
    if (s.lift < before)
      throw at("lift", `steps stand in order of their lift, the one before lifts at ${before} s`);
    if (s.land <= s.lift) throw at("land", `must come after lift, ${s.lift} s`);
    if (s.lift < free[s.foot])
      throw at("lift", `the ${s.foot} foot is still moving until ${free[s.foot].toFixed(3)} s`);
    const from = feet[s.foot];
    const step: ScoreStep = { ...s, x: s.x ?? from.x, z: s.z ?? from.z, yaw: wrapAngle(s.yaw) };
    if (s.kind === "heelPivot" || s.kind === "toePivot") {
      const to = pivotPlace(shape, from, s.yaw, s.kind === "heelPivot" ? "heel" : "ball");
      if (s.x !== undefined && Math.hypot(step.x - to.x, step.z - to.z) > 1e-3)
        throw at(
          "x",
          `a pivot to this yaw ends at ${to.x.toFixed(3)}, ${to.z.toFixed(3)}; leave x and z out to have them`,
        );
      // As it stands in the text where it does, so that what is written is read the same.
      if (s.x === undefined) Object.assign(step, { x: to.x, z: to.z });
    } else if (s.x === undefined || s.z === undefined)
      throw at(s.x === undefined ? "x" : "z", "a number is needed");
    before = s.lift;
    free[s.foot] = s.land;
    feet[s.foot] = step;
    score.steps.push(step);
  });
  const last = checkEvents(score.events);
  score.duration = d.duration ?? Math.max(last, ...score.steps.map((s) => s.land), 0) + AFTER;
  return score;
}

/** Checks the order of times and of lifting and placing; the end of the last task. @throws ScoreError */
function checkEvents(events: readonly ScoreEvent[]): number {
  let last = 0;
  let holds = false;
  events.forEach((e, i) => {
    const { start, contact, end } = e.task;
    if (contact < start)
      throw new ScoreError(`events[${i}].task.contact: must not come before start, ${start} s.`);
    if (end < contact)
      throw new ScoreError(`events[${i}].task.end: must not come before contact, ${contact} s.`);
    if (e.type === "lift" && holds)
      throw new ScoreError(`events[${i}]: a box is held already; a place event must come between.`);
    if (e.type === "place" && !holds) throw new ScoreError(`events[${i}]: there is no box to put down.`);
    if (e.type === "lift") holds = true;
    if (e.type === "place") holds = false;
    if (e.type === "write")
      e.strokes.forEach((s, k) => {
        if (s.times.length !== s.points.length || s.times.length === 0)
          throw new ScoreError(
            `events[${i}].strokes[${k}]: ${s.points.length} points, ${Math.max(1, s.times.length)} expected.`,
          );
        for (let j = 1; j < s.times.length; j++)
          if (s.times[j] <= s.times[j - 1])
            throw new ScoreError(
              `events[${i}].strokes[${k}].times[${j}]: must be later than the one before.`,
            );
      });
    last = Math.max(last, end);
  });
  return last;
}

/** A record without its undefined fields. */
function defined<T extends object>(record: T): { [K in keyof T]: Exclude<T[K], undefined> } {
  return Object.fromEntries(Object.entries(record).filter(([, x]) => x !== undefined)) as {
    [K in keyof T]: Exclude<T[K], undefined>;
  };
}

/** A score as its JSON text, a line a step; `readScore` reads it to the same score. */
export function writeScore(score: Score): string {
  const { shape, ...actor } = score.actor;
  const gait = GAIT_NAMES.find((name) => GAITS[name] === shape);
  const page = {
    version: 1,
    name: score.name,
    seed: score.seed,
    actor: { ...actor, ...(gait ? { gait } : {}) },
    duration: score.duration,
    start: score.start,
    ...(score.without?.length ? { without: score.without } : {}),
  };
  const rows = (name: string, items: readonly unknown[]) =>
    `  "${name}": [${items.map((x) => `\n    ${JSON.stringify(x)}`).join(",")}${items.length > 0 ? "\n  " : ""}]`;
  const head = Object.entries(page).map(([k, x]) => `  "${k}": ${JSON.stringify(x)}`);
  return `{\n${[...head, rows("steps", score.steps), rows("events", score.events), rows("gaze", score.gaze)].join(",\n")}\n}\n`;
}
