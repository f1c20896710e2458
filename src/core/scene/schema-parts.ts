/** What the schemas of documents are made of, and how a fault that they find is told: "tasks[2].yaw: a number is needed, found \"left\"." */
import * as v from "valibot";

export const finite = v.pipe(v.number("a number is needed"), v.finite("a finite number is needed"));
export const within = (low: number, high: number) =>
  v.pipe(
    finite,
    v.minValue(low, `at least ${low} is needed`),
    v.maxValue(high, `at most ${high} is possible`),
  );
export const place = within(-1000, 1000);
export const positive = within(0.001, 1000);
export const id = v.pipe(
  v.string("a text is needed"),
  v.minLength(1, "a text that is not empty is needed"),
  v.maxLength(80, "at most 80 characters are possible"),
);
export const point2 = v.tuple([place, place], "two numbers are needed");
export const point3 = v.tuple([place, place, place], "three numbers are needed");
export const angle = within(-1000, 1000);
export const object = <E extends v.ObjectEntries>(entries: E) =>
  v.strictObject(entries, "an object is needed");
export const list = <S extends v.BaseSchema<unknown, unknown, v.BaseIssue<unknown>>>(item: S, most: number) =>
  v.pipe(v.array(item, "a list is needed"), v.maxLength(most, `at most ${most} entries are possible`));
export const oneOf = <T extends readonly [string, ...string[]]>(values: T) =>
  v.picklist(values, `one of ${values.join(", ")} is needed`);

/** How a value is shown in an error: short. */
export function shown(value: unknown): string {
  if (value === undefined) return "nothing";
  if (typeof value === "number" || typeof value === "boolean" || value === null) return String(value);
  if (typeof value === "string")
    return JSON.stringify(value.length > 40 ? `${value.slice(0, 37)}...` : value);
  return Array.isArray(value) ? `a list of ${value.length}` : `an ${typeof value}`;
}

/** A key as it stands in a path: as it is where it is a word, else quoted and short. A document's keys may hold anything. */
const named = (key: string): string => (/^[\w-]{1,40}$/.test(key) ? key : shown(key));

/** "tasks[2].yaw" from valibot's path. */
function dotted(path: readonly { key?: unknown }[] | undefined, whole: string): string {
  let out = "";
  for (const item of path ?? [])
    out += typeof item.key === "number" ? `[${item.key}]` : `${out ? "." : ""}${named(String(item.key))}`;
  return out || whole;
}

/**
 * The first fault of a document as one sentence.
 *
 * @param whole what the document itself is called: "scene".
 */
export function faultOf(issue: v.BaseIssue<unknown>, whole: string): string {
  const where = dotted(issue.path as readonly { key?: unknown }[] | undefined, whole);
  if (issue.type === "strict_object" && issue.expected === "never")
    return `${where}: no such field is known.`;
  const needed =
    issue.type === "strict_object" && issue.received === "undefined" ? "this field is needed" : issue.message;
  return `${where}: ${needed}, found ${shown(issue.input)}.`;
}
