/** Any straight sample becomes a style [Express §§5, 8]: what it is called, and what is told of it. */
import { importBvh } from "../capture/import.ts";
import { cutLoop, type LoopSequence } from "./loop.ts";

/** Longest name of a style, characters: the scene document's limit on names is wider. */
const LONGEST_NAME = 40;

/** What a style is, for showing. */
export interface StyleFacts {
  name: string;
  /** Steps of its loop, and of those that the sample had. */
  steps: number;
  /** One pass of the loop, seconds. */
  seconds: number;
  /** Metres a second, on the body it was captured from. */
  speed: number;
  /** Frames blended at the joint, 60 Hz. */
  blended: number;
}

/** A file's name as a style's: without folder and ending, lower case, words apart by single spaces. */
export function styleName(file: string): string {
  const base = file.split(/[\\/]/).pop() ?? file;
  const words = base
    .replace(/\.[^.]*$/, "")
    .toLowerCase()
    .replace(/[^\p{L}\p{N}]+/gu, " ")
    .trim();
  return words.slice(0, LONGEST_NAME).trim() || "style";
}

/** A name that none of `taken` has: the name itself, else with a number after it. */
export function freeName(name: string, taken: Iterable<string>): string {
  const others = new Set(taken);
  if (!others.has(name)) return name;
  let k = 2;
  while (others.has(`${name} ${k}`)) k++;
  return `${name} ${k}`;
}

/** Facts of a loop. */
export function styleFacts(loop: LoopSequence): StyleFacts {
  return {
    name: loop.name,
    steps: 2 * loop.strides,
    seconds: loop.frames / 60,
    speed: 60 * loop.speed,
    blended: loop.blended,
  };
}

/**
 * Makes a style of a BVH file that holds one straight, unlabelled sample.
 *
 * @param file its name, for messages; @param name what the style is to be called.
 * @throws BvhError, StyleError with one sentence that begins with the file's name.
 */
export function styleFromBvh(text: string, file: string, name: string): LoopSequence {
  const { clip } = importBvh(text, file);
  return { ...cutLoop(clip, file), name };
}
