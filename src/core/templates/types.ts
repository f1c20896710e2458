/** The footstep-strategy templates and the library they live in [TaskLoco §4]. */
import type { Clip } from "../capture/clip.ts";
import type { SidecarTask } from "../capture/sidecar.ts";
import type { Effort, TaskCategory } from "../scene/task-types.ts";
import type { ContactTrack, Footstep, Step } from "../steps/types.ts";

/** A capture prepared for use: everything downstream reads this, never the BVH. */
export interface LibraryClip {
  clip: Clip;
  contacts: ContactTrack;
  tasks: SidecarTask[];
  /** In order of `start`. */
  steps: Step[];
  /** Where each foot rests in frame 0: left, right. */
  initialStance: [Footstep, Footstep];
}

/** Transition descriptor of eqs. 5 and 10, lengths in metres at the library's own actor's scale. */
export interface TransitionDescriptor {
  category: TaskCategory;
  /** Next task in the frame of the current one: lateral, forward. */
  nextInCurrent: [number, number];
  /** Current task (or start) in the frame of the next one: lateral, forward. */
  currentInNext: [number, number];
  currentEffort: Effort;
  nextEffort: Effort;
  /** Followup task in the frame of the next one, when there is one. */
  followupInNext: [number, number] | null;
  followupEffort: Effort | null;
}

/** Eqs. 3 and 4: a run of steps of one clip in one phase. */
export interface Template {
  /** Unique in the library, stable over builds: clip name, phase and first step. */
  id: string;
  phase: "exit" | "enter";
  /** Index of the clip in the library. */
  clip: number;
  /** Steps of that clip: first and one past the last. */
  first: number;
  last: number;
  descriptor: TransitionDescriptor;
  /** Index of the task in the clip that is left (exit) or entered (enter). */
  task: number;
  /** Foot that stands alone at the task when the phase ends or begins in single stance, else null. */
  singleStance: "left" | "right" | null;
  /** True when the steps are of the mirrored clip. */
  mirrored: boolean;
}

export interface Library {
  version: 1;
  clips: LibraryClip[];
  templates: Template[];
  /** Steps of category Walk in phase locomotion: [clip, step]. */
  walks: [number, number][];
  /** Enter radius of each task category, metres at the library's own scale [TaskLoco §4.1]. */
  enterRadius: Record<TaskCategory, number>;
  /** transitions[a][b]: how often a step of category b follows one of a [TaskLoco Figure 5]. */
  transitions: number[][];
}
