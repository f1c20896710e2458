/** An opened capture on the page. */
import type { ImportReport } from "../../core/capture/import.ts";
import type { SidecarTask } from "../../core/capture/sidecar.ts";
import type { CleanReport } from "../../core/cleanup/clean-bvh.ts";
import type { LabelTrack } from "../../core/contacts/label-track.ts";
import type { Step } from "../../core/steps/types.ts";
import type { ClipData, FootCurves } from "../../workers/contacts-protocol.ts";

export interface Capture {
  key: string;
  name: string;
  file: Blob;
  mapping: Record<string, string> | null;
  report: ImportReport;
  /** Names of the file's joints. */
  joints: string[];
  clip: ClipData;
  curves: FootCurves;
  /** Share of the oracle's votes, frames x 4. */
  share: Float32Array;
  edits: LabelTrack;
  tasks: SidecarTask[];
  /** Steps as found, and whether a person has corrected them since. */
  steps: Step[] | null;
  stepsEdited: boolean;
  inLibrary: boolean;
  /** What it is called among the clips that steps on stones are blended of; null when it is not one. */
  cycle: string | null;
  cleaned: { text: string; clip: ClipData; report: CleanReport; skate: [number, number] } | null;
}

/** Frames of the clip's rate [first, last) that are shown and labelled together. */
export interface Stretch {
  first: number;
  last: number;
}
