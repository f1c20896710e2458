/** A crowd's world and what comes of it. Metres, seconds; ground points are x, z. */

/** A wall or pillar: a box turned about the upright, or a disc. */
export interface Obstacle {
  x: number;
  z: number;
  /** Half sizes along its own x and z; a disc has its radius in both and `round` set. */
  halfX: number;
  halfZ: number;
  cos: number;
  sin: number;
  round: boolean;
}

export interface CrowdAgent {
  x: number;
  z: number;
  /** Facing at the start, unit vector. */
  dirX: number;
  dirZ: number;
  /** Goals in order: points, or boxes [x0, x1, z0, z1]; with the speed wanted on the way there. */
  goals: CrowdGoal[];
}

export interface CrowdGoal {
  x: number;
  z: number;
  box: [number, number, number, number] | null;
  /** Metres a second. */
  speed: number;
  /** Seconds after which the goal is given up; Infinity for never. */
  patience: number;
}

export interface CrowdWorld {
  name: string;
  obstacles: Obstacle[];
  agents: CrowdAgent[];
  /** What was put right while reading, one sentence each. */
  repairs: string[];
}

/** How a walker steps [Footsteps §3.3, user parameters]. */
export interface Gait {
  /** Mass-specific power at rest, W/kg [Footsteps eq. 14]. */
  power: number;
  /** Weight of the force that bends the way [Footsteps eq. 16]. */
  bend: number;
  /** Height of the pelvis, metres: leg of the pendulum. */
  leg: number;
  /** From the body's middle to a foot at rest, metres. */
  footAside: number;
  /** Step times by speed: quick, slow, seconds (multiples of the tick). */
  quick: number;
  slow: number;
  /** Most that a step turns the way, radians. */
  mostTurn: number;
}

export const DEFAULT_GAIT: Gait = {
  power: 2.23,
  bend: 0.35,
  leg: 0.9,
  footAside: 0.09,
  quick: 0.5,
  slow: 0.6,
  mostTurn: 1.3,
};

/** Radius of torso and shoulder circles and the shoulders' way from the middle [Footsteps Figure 1c]. */
export const BODY_RADIUS = 0.15;
export const SHOULDER = 0.15;
export const FOOT_RADIUS = 0.08;
/** Planning and output happen on these ticks, seconds. */
export const TICK = 0.05;
