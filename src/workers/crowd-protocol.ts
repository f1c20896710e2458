/**
 * Messages between the page and the crowd worker. The page asks for one moment after the other (`show`); each is answered by one
 * `frame`, whose arrays the page gives back with the next request, so that nothing is allocated while a crowd runs.
 */
import type { CrowdFootstep } from "../core/crowd/footfalls.ts";
import type { PlanStory } from "../core/crowd/plan-story.ts";
import type { CrowdWorld } from "../core/crowd/types.ts";
import type { CharacterMesh } from "../view/character/build-mesh.ts";

export type CrowdRequest =
  /** A crowd from its beginning. Answered by `ready` once it can be shown. */
  | { type: "start"; id: number; world: CrowdWorld }
  /** Other walls or goals for the same agents, from what is shown on; other agents begin anew. Answered by `changed`. */
  | { type: "change"; id: number; world: CrowdWorld }
  /** The crowd at a moment, seconds; `picked` is the agent whose plan is told, -1 for none; `frame` is an old answer's, to be filled. */
  | { type: "show"; id: number; seconds: number; picked: number; frame: CrowdFrame | null }
  /** Meshes for near and far, 20 and 40 mm. Answered by `meshes`. */
  | { type: "meshes" }
  /** A world simulated to its end, and a hash of all trajectories. Answered by `simulated`. */
  | { type: "simulate"; id: number; world: CrowdWorld; seconds: number };

/** Everybody at a moment. */
export interface CrowdFrame {
  seconds: number;
  count: number;
  /** Skinning matrices, three rows of four a joint, 22 joints an agent. */
  matrices: Float32Array;
  /** Hips of each, world x, y, z; and facing x, z of the torso. */
  places: Float32Array;
  /** 1 for those who have not arrived. */
  here: Uint8Array;
}

export type CrowdResponse =
  | { type: "ready"; id: number; agents: number; repairs: string[] }
  | { type: "changed"; id: number; again: boolean }
  | {
      type: "frame";
      id: number;
      frame: CrowdFrame;
      /** False while the simulation catches up: ask again for the same moment. */
      reached: boolean;
      left: number;
      story: PlanStory | null;
      /** The picked agent's footsteps around the moment. */
      footsteps: CrowdFootstep[];
      figures: { plans: number; expanded: number; generated: number; simulatedMs: number; ticks: number };
    }
  | { type: "meshes"; meshes: CharacterMesh[] }
  | { type: "simulated"; id: number; hash: string; arrived: number; ticks: number }
  | { type: "failed"; id: number; message: string };
