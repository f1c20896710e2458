/**
 * What is known about a capture beside its motion: the sidecar `name.json` of DESIGN's captures.
 *
 * A user's own BVH may come with one written by hand: only `tasks` is needed to make templates of it.
 */
import type { Effort, TaskCategory } from "../scene/task-types.ts";

export interface SidecarTask {
  category: TaskCategory;
  effort: Effort;
  /**
   * The task frame: place as in the scene document (point written at, centre of the box, middle of the seat,
   * ground point of a turn), metres.
   */
  position: [number, number, number];
  /** Way the character faces while doing it, radians. */
  yaw: number;
  /** Seconds: body settles into the task / hand, seat or box meets its target / body begins to leave. */
  start: number;
  contact: number;
  end: number;
  /** Hand that acts in `write`. */
  hand: "left" | "right" | "both";
}

export interface Sidecar {
  version: 1;
  name: string;
  licence: string;
  /** Standing height of the actor, metres. */
  height: number;
  rate: number;
  tasks: SidecarTask[];
  /** Exact contacts of synthesised captures, run-length: [first frame, last frame (exclusive)] per bit. */
  contacts?: {
    leftHeel: [number, number][];
    leftToe: [number, number][];
    rightHeel: [number, number][];
    rightToe: [number, number][];
  };
  /** Exact steps of synthesised captures, for training and tests only. */
  steps?: {
    foot: "left" | "right";
    category: string;
    lift: number;
    land: number;
    x: number;
    z: number;
    yaw: number;
  }[];
  /** Mass carried between lift and place, kilograms. */
  load?: number;
}
