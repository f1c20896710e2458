/**
 * Reading BVH: tolerant of what tools write, exact about what is wrong.
 *
 * 3 or 6 channels a joint (or any number) in any order, End Sites, tabs, CRLF, exponents, blank lines. Errors name the file and the
 * line. Time is linear in the size of the text. The reader takes the text in pieces, so that a file of any size needs no more room than its
 * numbers and one line.
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
/** Longest line, characters: 6000 channels of 20 digits are an eighth of it. */
const LONGEST_LINE = 1 << 20;

/** Takes a file's text piece by piece. */
export interface BvhReader {
  /** The next piece of the text, cut anywhere. @throws BvhError naming file and line. */
  push(piece: string): void;
  /** The file, after the last piece. @throws BvhError when it ends too soon. */
  end(): BvhFile;
}

/**
 * A reader for one file.
 *
 * @param size length of the whole text (or its bytes): the room made for numbers is never more than it could fill.
 */
export function createBvhReader(name: string, size: number): BvhReader {
  let line = 0;
  let rest = "";
  const fail = (what: string): never => {
    throw new BvhError(`${name}, line ${Math.max(1, line)}: ${what}`);
  };
  const number = (s: string | undefined): number => {
    const n = s === undefined || s === "" ? Number.NaN : Number(s);
    if (!(Math.abs(n) < LARGEST))
      fail(`a number is needed, found ${s === undefined ? "nothing" : JSON.stringify(s.slice(0, 30))}.`);
    return n;
  };
  const joints: BvhJoint[] = [];
  const names = new Set<string>();
  /** Open braces: joint index, or -2 for an End Site. */
  const stack: number[] = [];
  let pending: number | null = null;
  let columns = 0;
  let state: "first" | "hierarchy" | "frames" | "time" | "motion" = "first";
  let frames = 0;
  let frameTime = 0;
  let values = new Float64Array(0);
  let read = 0;

  const hierarchy = (s: string): void => {
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
        if (joints.length === 0) fail("no ROOT.");
        state = "frames";
      } else fail(`${JSON.stringify(words[0].slice(0, 30))} is not expected here.`);
    }
  };

  const row = (s: string): void => {
    // What follows the last frame is passed over.
    if (read === frames) return;
    const words = s.split(/\s+/);
    if (words.length !== columns) fail(`${words.length} numbers, ${columns} expected.`);
    for (let c = 0; c < columns; c++) {
      const n = Number(words[c]);
      if (!(Math.abs(n) < LARGEST))
        fail(`a number is needed, found ${JSON.stringify(words[c].slice(0, 30))}.`);
      values[read * columns + c] = n;
    }
    read++;
  };

  const take = (s: string): void => {
    switch (state) {
      case "first":
        if (!/^HIERARCHY$/i.test(s.replace(/^\uFEFF/, "")))
          fail("HIERARCHY is expected; this is no BVH file.");
        state = "hierarchy";
        break;
      case "hierarchy":
        hierarchy(s);
        break;
      case "frames":
        frames = number(/^Frames:\s*(\S+)$/i.exec(s)?.[1]);
        if (!Number.isInteger(frames) || frames < 1) fail(`at least one frame is needed, found ${frames}.`);
        if (frames > MOST_FRAMES) fail(`at most ${MOST_FRAMES} frames are possible, found ${frames}.`);
        state = "time";
        break;
      case "time":
        frameTime = number(/^Frame\s+Time:\s*(\S+)$/i.exec(s)?.[1]);
        if (!(frameTime > 1e-5 && frameTime < 10))
          fail(`a Frame Time between 0.00001 and 10 seconds is needed, found ${frameTime}.`);
        // Never more room than the text could fill.
        if (frames * columns > size)
          fail(`${frames} frames of ${columns} numbers are promised; the file is too short for them.`);
        values = new Float64Array(frames * columns);
        state = "motion";
        break;
      default:
        row(s);
    }
  };

  const wholeLine = (text: string): void => {
    line++;
    const s = text.trim();
    if (s !== "") take(s);
  };

  return {
    push(piece) {
      let from = 0;
      for (let end = piece.indexOf("\n"); end >= 0; end = piece.indexOf("\n", from)) {
        wholeLine(rest + piece.slice(from, end));
        rest = "";
        from = end + 1;
      }
      rest += piece.slice(from);
      if (rest.length > LONGEST_LINE) {
        line++;
        fail(`a line longer than ${LONGEST_LINE} characters.`);
      }
    },
    end() {
      if (rest !== "") wholeLine(rest);
      rest = "";
      if (state === "first") fail("HIERARCHY is expected; this is no BVH file.");
      if (state === "hierarchy") fail("the file ends before MOTION.");
      if (state === "frames") fail("the file ends before Frames.");
      if (state === "time") fail("the file ends before Frame Time.");
      if (read < frames) fail(`the file ends after ${read} of ${frames} frames.`);
      return { name, joints, frameTime, frames, columns, values };
    },
  };
}

/**
 * Reads BVH text.
 *
 * @throws BvhError naming file and line.
 */
export function parseBvh(text: string, name: string): BvhFile {
  const reader = createBvhReader(name, text.length);
  reader.push(text);
  return reader.end();
}

/**
 * Reads BVH from a stream of UTF-8 bytes, one piece in memory at a time: `readBvhStream(file.stream(), file.size, file.name)`.
 *
 * @param size bytes of the whole file.
 * @throws BvhError naming file and line; the stream is cancelled.
 */
export async function readBvhStream(
  stream: ReadableStream<Uint8Array>,
  size: number,
  name: string,
): Promise<BvhFile> {
  const source = stream.getReader();
  const decoder = new TextDecoder();
  const reader = createBvhReader(name, size);
  try {
    for (let next = await source.read(); !next.done; next = await source.read())
      reader.push(decoder.decode(next.value, { stream: true }));
    reader.push(decoder.decode());
    return reader.end();
  } catch (error) {
    await source.cancel(error);
    throw error;
  }
}
