/**
 * Messages between the page and the planner worker: one typed map, plain records and typed arrays.
 *
 * Order of answers to one `plan` request: `planned` (footsteps, at once), then `motion` chunks in playing order,
 * then `finished`. A newer `plan` request makes the worker drop what it was doing; the older one is answered by
 * `dropped`. Every answer carries the request's id.
 */
import type { BoxTrack, InkStroke, MotionChunk, QualityFigures } from "../core/motion/types.ts";
import type { Scene } from "../core/scene/types.ts";
import type { PathStory } from "../core/styles/story.ts";
import type { PathOptions } from "../core/styles/synthesise-path.ts";
import type { StyleFacts } from "../core/styles/user-style.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import type { ClipData } from "./contacts-protocol.ts";

export type PlannerRequest =
  | {
      type: "plan";
      id: number;
      /** Who asks: the plan being played is remembered for each asker. A page of its own uses 0. */
      client: number;
      scene: Scene;
      /**
       * Playing time, seconds, when an earlier answer is being played: steps begun by then are kept as they are.
       * Null plans from the start.
       */
      now: number | null;
      /** Frame from which motion is wanted first (what is shown); chunks come from there on, then the rest. */
      fromFrame: number;
      /** For stones: 0 follows the footsteps, 1 the root alone [Barycentric §5]; left out: 0. */
      lambda4?: number;
      /** Enhancements of walks along paths that are switched off or on; what is left out is on. */
      paths?: Partial<PathOptions>;
    }
  | { type: "cancel"; id: number }
  /** A straight sample as BVH becomes a style of that name for all later plans. Answered by `style` or `style-failed`. */
  | { type: "style"; name: string; file: string; text: string }
  | { type: "forget-style"; name: string }
  /**
   * A capture joins the clips that steps on stones are blended of, or replaces the one of that name. Answered by `cycle` or
   * `cycle-failed`. `contacts`: one byte a frame of the clip.
   */
  | { type: "cycle"; name: string; clip: ClipData; contacts: Uint8Array }
  | { type: "forget-cycle"; name: string }
  /** First: where the library is, or its bytes. Answered by `ready` or `failed` with id 0. */
  | { type: "load"; url: string }
  | { type: "load"; bytes: Uint8Array }
  /** A person's own library beside the loaded one, or none any more. Answered by `ready` or `failed` with id 0. */
  | { type: "own"; bytes: Uint8Array | null };

export type PlannerResponse =
  /** The worker runs and has begun to load. */
  | { type: "started" }
  | { type: "ready"; templates: number; clips: number; transitions: number[][] }
  | {
      type: "planned";
      id: number;
      plan: Plan;
      planMs: number /** Frames of the whole motion. */;
      frames: number;
      /** What happens along the paths, where there are any. */
      story?: PathStory;
    }
  /** Loops with shorter strides are being built ahead, one style after the other: members done of how many. */
  | { type: "families"; id: number; style: string; done: number; of: number }
  /** A sample has become a style. */
  | { type: "style"; facts: StyleFacts }
  /** The styles that ship, once after the first walk. */
  | { type: "styles"; facts: StyleFacts[] }
  | { type: "style-failed"; name: string; message: string }
  /** A capture is blended of from now on; the shipped clip of its name is not any more. */
  | { type: "cycle"; name: string; replaces: boolean }
  | { type: "cycle-failed"; name: string; message: string }
  | { type: "motion"; id: number; chunk: MotionChunk }
  | {
      type: "finished";
      id: number;
      boxes: BoxTrack[];
      ink: InkStroke[];
      quality: QualityFigures;
      motionMs: number;
    }
  | { type: "dropped"; id: number }
  /** A newer request came while this one was worked on: `dropped` follows. */
  | { type: "overtaken"; id: number }
  | { type: "failed"; id: number; message: string };
