/**
 * Messages between the page and the worker of captures: files read and imported, contacts found, the oracle trained,
 * footskate removed, steps told apart, a library made.
 *
 * Every request with an `id` is answered once by `failed`, `cancelled` or what it asks for, after any number of `progress`.
 * `cancel` stops it at its next slice. The worker keeps opened captures by their key until `close`.
 */
import type { ImportReport } from "../core/capture/import.ts";
import type { SidecarTask } from "../core/capture/sidecar.ts";
import type { CleanReport } from "../core/cleanup/clean-bvh.ts";
import type { Segment } from "../core/contacts/active-learning.ts";
import type { Step } from "../core/steps/types.ts";

/** A motion on our skeleton as it travels: 60 Hz. */
export interface ClipData {
  frames: number;
  rate: number;
  /** Standing height of the skeleton, metres. */
  height: number;
  /** frames x 3 and frames x JOINT_COUNT x 4. */
  root: Float32Array;
  rotations: Float32Array;
}

/** Heights (metres) and speeds (metres a second) of left heel, left toe, right heel, right toe: frames x 4. */
export interface FootCurves {
  heights: Float32Array;
  speeds: Float32Array;
}

/** What the oracle thinks of a capture. */
export interface Thought {
  key: string;
  /** One byte a frame. */
  labels: Uint8Array;
  /** Share of votes, frames x 4. */
  share: Float32Array;
}

/** Frames of a capture that a person has labelled. */
export interface Lesson {
  key: string;
  labels: Uint8Array;
  /** 1 for frames to learn from. */
  mask: Uint8Array;
}

/** A capture as it joins the library. */
export interface LibraryEntry {
  key: string;
  contacts: Uint8Array;
  tasks: SidecarTask[];
  /** Steps corrected by hand; null takes them as they are found. */
  steps: Step[] | null;
}

export type ContactsRequest =
  /** First: the model to begin with. Answered by `ready`, or by `failed` with id 0. */
  | { type: "model"; url: string }
  | { type: "model"; bytes: Uint8Array; name: string }
  /** A BVH file, read in pieces. `mapping`: our joint to the name of the file's, "" for none. */
  | {
      type: "open";
      id: number;
      key: string;
      name: string;
      file: Blob;
      mapping: Record<string, string> | null;
    }
  | { type: "train"; id: number; lessons: Lesson[] }
  | { type: "steps"; id: number; key: string; contacts: Uint8Array; tasks: SidecarTask[] }
  | { type: "clean"; id: number; key: string; contacts: Uint8Array }
  | { type: "library"; id: number; entries: LibraryEntry[] }
  /** The model as a file. */
  | { type: "save"; id: number }
  | { type: "close"; key: string }
  | { type: "cancel"; id: number };

/** What is being done: for the words beside a bar. */
export type Doing = "reading" | "importing" | "contacts" | "cleaning";

export type ContactsResponse =
  | { type: "ready"; examples: number }
  | { type: "progress"; id: number; doing: Doing; name: string; share: number }
  | {
      type: "opened";
      id: number;
      key: string;
      report: ImportReport;
      /** Names of the file's joints, for the mapping. */
      joints: string[];
      clip: ClipData;
      curves: FootCurves;
      thought: Thought;
    }
  | {
      type: "trained";
      id: number;
      examples: number;
      /** Share of labels that the oracle is sure of: at least nine of ten votes. */
      sure: number;
      thoughts: Thought[];
      /** Keys in the order that `segments` counts them in, and segments, the most foreign first. */
      keys: string[];
      segments: Segment[];
    }
  | { type: "steps"; id: number; key: string; steps: Step[] }
  | {
      type: "cleaned";
      id: number;
      key: string;
      text: string;
      clip: ClipData;
      report: CleanReport;
      /** Largest slide of a planted point in a plant, 95th percentile, millimetres, before and after. */
      skate: [number, number];
    }
  | { type: "library"; id: number; bytes: Uint8Array; clips: number; templates: number; walks: number }
  | { type: "saved"; id: number; bytes: Uint8Array }
  | { type: "cancelled"; id: number }
  | { type: "failed"; id: number; message: string };
