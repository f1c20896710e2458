/** Weights of the five objectives in each phase [TaskLoco Table 2]. */

export const PHASE_NAMES = ["exit", "locomotion", "enterPreparation", "enter"] as const;
export type PhaseName = (typeof PHASE_NAMES)[number];

/** In the order of eq. 11: data prior, smooth step, orientation, distance from goal, location. */
export type ObjectiveWeights = readonly [number, number, number, number, number];

export const PHASE_WEIGHTS: Record<PhaseName, ObjectiveWeights> = {
  exit: [0.4, 0.1, 0.4, 0.0, 0.1],
  locomotion: [0.4, 0.2, 0.2, 0.0, 0.2],
  enterPreparation: [0.4, 0.1, 0.1, 0.3, 0.1],
  enter: [0.4, 0.1, 0.0, 0.5, 0.0],
};

export const TERM_NAMES = ["data prior", "smooth step", "orientation", "goal", "location"] as const;
