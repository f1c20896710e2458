/**
 * Reading BVH: tolerant of what tools write, exact about what is wrong.
 *
 * 3 or 6 channels a joint (or any number) in any order, End Sites, tabs, CRLF, exponents, blank lines. Errors name the file and the
 * line. Time is linear in the size of the text.
 */

export const BVH_CHANNELS = [
  "Xposition",
  "Yposition",
  "Zposition",
  "Xrotation",
  "Yrotation",
  "Zrotation",
] as const;
export type BvhChannel = (typeof BVH_CHANNELS)[number];

export interface BvhJoint {
  name: string;
  /** Index of the parent; -1 for the root. */
  parent: number;
  /** In the file's unit. */
  offset: [number, number, number];
  channels: BvhChannel[];
  /** Column of its first channel. */
  column: number;
  endSites: [number, number, number][];
}

export interface BvhFile {
  name: string;
  joints: BvhJoint[];
  /** Seconds a frame. */
  frameTime: number;
  frames: number;
  columns: number;
  /** frames x columns; angles in degrees. */
  values: Float64Array;
}

/** What is wrong with a file: "jump.bvh, line 412: 93 numbers, 96 expected." */
export class BvhError extends Error {
  override name = "BvhError";
}

/** Larger numbers are no metres, millimetres or degrees of a person. */
const LARGEST = 1e8;
const MOST_JOINTS = 1000;
const MOST_FRAMES = 2_000_000;

/**
 * Reads BVH text.
 *
 * @throws BvhError naming file and line.
 */
export function parseBvh(text: string, name: string): BvhFile {
  let at = 0;
  let line = 0;
  const fail = (what: string): never => {
    throw new BvhError(`${name}, line ${Math.max(1, line)}: ${what}`);
  };
  /** Next line that is not blank, trimmed; null at the end. */
  const next = (): string | null => {
    while (at < text.length) {
      let end = text.indexOf("\n", at);
      if (end < 0) end = text.length;
      const s = text.slice(at, end).trim();
      at = end + 1;
      line++;
      if (s !== "") return s;
    }
    return null;
  };
  const number = (s: string | undefined): number => {
    const n = s === undefined || s === "" ? Number.NaN : Number(s);
    if (!(Math.abs(n) < LARGEST))
      fail(`a number is needed, found ${s === undefined ? "nothing" : JSON.stringify(s.slice(0, 30))}.`);
    return n;
  };
  const first = next();
  if (first === null || !/^HIERARCHY$/i.test(first.replace(/^\uFEFF/, "")))
    fail("HIERARCHY is expected; this is no BVH file.");
  const joints: BvhJoint[] = [];
  const names = new Set<string>();
  /** Open braces: joint index, or -2 for an End Site. */
  const stack: number[] = [];
  let pending: number | null = null;
  let columns = 0;
  let motion = false;
  while (!motion) {
    const s = next();
    if (s === null) return fail("the file ends before MOTION.");
    // "JOINT a {" on one line reads as two.
    for (const part of s.replace(/([{}])/g, "\n$1\n").split("\n")) {
      const words = part.trim().split(/\s+/);
      const head = words[0].toUpperCase();
      if (head === "") continue;
      if (head === "ROOT" || head === "JOINT") {
        if (head === "ROOT" && joints.length > 0) fail("a second ROOT.");
        if (head === "JOINT" && stack.length === 0) fail("a JOINT outside of the ROOT.");
        if (stack.includes(-2)) fail("a JOINT inside of an End Site.");
        const joint = words.slice(1).join(" ");
        if (joint === "") fail("a joint without a name.");
        if (names.has(joint)) fail(`the joint ${JSON.stringify(joint)} stands twice.`);
        if (joints.length >= MOST_JOINTS) fail(`more than ${MOST_JOINTS} joints.`);
        names.add(joint);
        joints.push({
          name: joint,
          parent: stack.length > 0 ? stack[stack.length - 1] : -1,
          offset: [0, 0, 0],
          channels: [],
          column: 0,
          endSites: [],
        });
        pending = joints.length - 1;
      } else if (head === "END") {
        if (stack.length === 0) fail("an End Site outside of a joint.");
        if (stack.includes(-2)) fail("an End Site inside of an End Site.");
        pending = -2;
      } else if (head === "{") {
        if (pending === null) fail("a brace without a joint.");
        stack.push(pending as number);
        pending = null;
      } else if (head === "}") {
        if (stack.length === 0) fail("a brace too many.");
        stack.pop();
      } else if (head === "OFFSET") {
        const open = stack[stack.length - 1];
        if (open === undefined) fail("an OFFSET outside of a joint.");
        const v: [number, number, number] = [number(words[1]), number(words[2]), number(words[3])];
        if (open === -2) joints[stack[stack.length - 2]]?.endSites.push(v);
        else joints[open].offset = v;
      } else if (head === "CHANNELS") {
        const open = stack[stack.length - 1];
        if (open === undefined || open < 0) fail("CHANNELS outside of a joint.");
        const count = number(words[1]);
        const given = words.slice(2);
        if (given.length !== count) fail(`CHANNELS says ${count}, ${given.length} names follow.`);
        const channels = given.map((c) => {
          const found = BVH_CHANNELS.find((k) => k.toLowerCase() === c.toLowerCase());
          return found ?? fail(`no channel is called ${JSON.stringify(c)}.`);
        });
        joints[open].channels = channels;
        joints[open].column = columns;
        columns += channels.length;
      } else if (head === "MOTION") {
        if (stack.length > 0) fail("MOTION before the last brace.");
        motion = true;
      } else fail(`${JSON.stringify(words[0].slice(0, 30))} is not expected here.`);
    }
  }
  if (joints.length === 0) fail("no ROOT.");
  const framesLine = next() ?? fail("the file ends before Frames.");
  const frames = number(/^Frames:\s*(\S+)$/i.exec(framesLine)?.[1]);
  if (!Number.isInteger(frames) || frames < 1) fail(`at least one frame is needed, found ${frames}.`);
  if (frames > MOST_FRAMES) fail(`at most ${MOST_FRAMES} frames are possible, found ${frames}.`);
  const timeLine = next() ?? fail("the file ends before Frame Time.");
  const frameTime = number(/^Frame\s+Time:\s*(\S+)$/i.exec(timeLine)?.[1]);
  if (!(frameTime > 1e-5 && frameTime < 10))
    fail(`a Frame Time between 0.00001 and 10 seconds is needed, found ${frameTime}.`);
  // Never more room than the text could fill.
  if (frames * columns > text.length)
    fail(`${frames} frames of ${columns} numbers are promised; the file is too short for them.`);
  const values = new Float64Array(frames * columns);
  for (let f = 0; f < frames; f++) {
    const s = next();
    if (s === null) return fail(`the file ends after ${f} of ${frames} frames.`);
    const words = s.split(/\s+/);
    if (words.length !== columns) fail(`${words.length} numbers, ${columns} expected.`);
    for (let c = 0; c < columns; c++) {
      const n = Number(words[c]);
      if (!(Math.abs(n) < LARGEST))
        fail(`a number is needed, found ${JSON.stringify(words[c].slice(0, 30))}.`);
      values[f * columns + c] = n;
    }
  }
  return { name, joints, frameTime, frames, columns, values };
}
