/** Task categories and efforts of the scene document. */

export const TASK_CATEGORIES = ["write", "lift", "place", "sit", "stand", "turn"] as const;
export type TaskCategory = (typeof TASK_CATEGORIES)[number];

/** 0: within reach will do; 1: the comfortable place in front [TaskLoco §4.1, motion coarticulation]. */
export type Effort = 0 | 1;
