/**
 * Messages between the studio page and its worker. Each `walk` or `score` request is answered by `walked` or `failed` with
 * its id, unless a newer one came first: then by nothing. `save` asks for what was walked last, as a file's text; `left-out`
 * for the sequence that no library is made of, answered by `performed`.
 */

import type { SidecarTask } from "../core/capture/sidecar.ts";
import type { GaitAnalysis } from "../core/quality/gait.ts";
import type { Proportions } from "../core/skeleton/skeleton.ts";
import type { Footstep, StepCategory } from "../core/steps/types.ts";
import type { GaitRange } from "../studio/gait-range.ts";
import type { LayerTrack } from "../studio/layer-tracks.ts";
import type { Layer } from "../studio/score.ts";
import type { WalkSettings } from "../studio/walk-score.ts";

export type StudioRequest =
  | { type: "walk"; id: number; settings: WalkSettings }
  | { type: "score"; id: number; text: string; without: readonly Layer[] }
  | { type: "save"; id: number; what: "bvh" | "score" }
  | { type: "left-out"; id: number };

export interface Walked {
  type: "walked";
  id: number;
  name: string;
  height: number;
  proportions: Proportions;
  frames: number;
  /** frames x 3, and frames x joints x 4. */
  root: Float32Array;
  rotations: Float32Array;
  contacts: Uint8Array;
  /** The two start stances first; lift and land in seconds, 0 for those. */
  steps: (Footstep & { category: StepCategory | null; lift: number; land: number })[];
  /** Null where the motion has no steady cycle. */
  gait: GaitAnalysis | null;
  range: GaitRange | null;
  tracks: LayerTrack[];
}

/** A performance with its tasks: to be laid beside its plan. */
export interface PerformedSequence {
  type: "performed";
  id: number;
  name: string;
  height: number;
  proportions: Proportions;
  /** At 60 Hz; frames x 3, and frames x joints x 4. */
  frames: number;
  root: Float32Array;
  rotations: Float32Array;
  start: [Footstep, Footstep];
  steps: Footstep[];
  tasks: SidecarTask[];
}

export type StudioResponse =
  | Walked
  | PerformedSequence
  | { type: "saved"; id: number; name: string; text: string }
  | { type: "failed"; id: number; message: string };
