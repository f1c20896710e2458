/** Options of a command: `--name value [value ...]` and plain words. */
import { existsSync, statSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { makeFolder } from "./write.ts";

/** Wrong usage: exit code 2. */
export class UsageError extends Error {
  override name = "UsageError";
}

export interface Options {
  words: string[];
  values: Map<string, string[]>;
}

/**
 * Reads options.
 *
 * @param known names of options and whether they take values.
 * @param words whether the command takes plain words.
 * @throws UsageError for an unknown option, a missing value or a word that nothing asks for.
 */
export function readOptions(
  args: readonly string[],
  known: Record<string, "flag" | "one" | "many">,
  words = false,
): Options {
  const out: Options = { words: [], values: new Map() };
  let open: string | null = null;
  for (const a of args) {
    if (a.startsWith("--")) {
      const name = a.slice(2);
      if (!(name in known)) throw new UsageError(`${a}: no such option is known.`);
      open = known[name] === "flag" ? null : name;
      out.values.set(name, out.values.get(name) ?? []);
    } else if (open) {
      out.values.get(open)?.push(a);
      if (known[open] === "one") open = null;
    } else if (words) out.words.push(a);
    else throw new UsageError(`${a}: no word is expected here.`);
  }
  for (const [name, values] of out.values) {
    if (known[name] !== "flag" && values.length === 0) throw new UsageError(`--${name}: a value is needed.`);
  }
  return out;
}

/** One value, or undefined. */
export const one = (o: Options, name: string): string | undefined => o.values.get(name)?.[0];

/** One value. @throws UsageError when it is missing. */
export function needed(o: Options, name: string): string {
  const v = one(o, name);
  if (v === undefined) throw new UsageError(`--${name} is needed.`);
  return v;
}

/** Whether an output names a folder: by its slash, or because it is one. */
const isFolder = (out: string): boolean =>
  out.endsWith("/") || (existsSync(out) && statSync(out).isDirectory());

/**
 * Where the results of several inputs go, or of one into a folder: `DIR/NAME.ext`; of one, the file named. The folder is made, before any work is done for
 * what could not be kept.
 *
 * @throws Error "DIR: could not be made: ...", or for results that would overwrite each other or their input.
 */
export function outputs(inputs: readonly string[], out: string, extension: string): string[] {
  const single = inputs.length === 1 && !isFolder(out);
  const folder = single ? dirname(out) : out.replace(/(?<=.)\/$/, "");
  makeFolder(folder);
  if (single) return [out];
  const from = new Map<string, string>();
  return inputs.map((i) => {
    const to = `${folder}/${baseName(i)}.${extension}`;
    const other = from.get(to) ?? i;
    if (other !== i) throw new Error(`${i}: its result would take the place of that of ${other}, ${to}.`);
    if (resolve(to) === resolve(i))
      throw new Error(`${i}: its result would take its own place; another folder is needed.`);
    from.set(to, i);
    return to;
  });
}

export const baseName = (path: string): string => (path.split(/[\\/]/).pop() ?? path).replace(/\.[^.]*$/, "");
