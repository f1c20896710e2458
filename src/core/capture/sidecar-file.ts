/** Reading a capture's sidecar. */
import * as v from "valibot";
import { readJson } from "../scene/json-text.ts";
import { TASK_CATEGORIES } from "../scene/task-types.ts";
import type { Sidecar } from "./sidecar.ts";

const number = v.pipe(v.number("a number is needed"), v.finite("a finite number is needed"));
/** A task of a capture. */
export const sidecarTask = v.object(
  {
    category: v.picklist(TASK_CATEGORIES, `one of ${TASK_CATEGORIES.join(", ")} is needed`),
    effort: v.optional(v.picklist([0, 1] as const, "0 or 1 is needed"), 1),
    position: v.tuple([number, number, number], "three numbers are needed"),
    yaw: number,
    start: number,
    contact: number,
    end: number,
    hand: v.optional(v.picklist(["left", "right", "both"] as const, "left, right or both is needed"), "both"),
  },
  "an object is needed",
);
const sidecar = v.looseObject(
  {
    version: v.literal(1, "version 1 is needed"),
    name: v.optional(v.string(), ""),
    licence: v.optional(v.string(), ""),
    height: v.optional(number, 1.75),
    rate: v.optional(number, 60),
    tasks: v.optional(v.array(sidecarTask, "a list is needed"), []),
  },
  "an object is needed",
);

/** A sidecar from JSON text; only `version` is needed. @throws Error "F: tasks[0].yaw: a number is needed." */
export function parseSidecar(text: string, name: string): Sidecar {
  let value: unknown;
  try {
    value = readJson(text);
  } catch (error) {
    throw new Error(`${name}: ${error instanceof Error ? error.message : String(error)}`);
  }
  const result = v.safeParse(sidecar, value, { abortEarly: true });
  if (!result.success)
    throw new Error(`${name}: ${v.getDotPath(result.issues[0]) ?? "sidecar"}: ${result.issues[0].message}.`);
  return result.output as Sidecar;
}
