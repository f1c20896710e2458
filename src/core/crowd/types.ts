/** A crowd's world and what comes of it. Metres, seconds; ground points are x, z. */
import { GRAVITY } from "../math/gravity.ts";

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
  /** How it steps, where that is not the default [Footsteps §3.3, user parameters]. */
  gait?: Partial<Gait>;
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

/** Ground that costs more (or less) energy to cross than plain floor: a road beside a pavement [Footsteps §4, soft constraints]. */
export interface Surface {
  /** x0, x1, z0, z1. */
  bounds: [number, number, number, number];
  /** Energy of a step on it over that on plain floor, 1 to 20. */
  cost: number;
}

export interface CrowdWorld {
  name: string;
  obstacles: Obstacle[];
  agents: CrowdAgent[];
  surfaces?: Surface[];
  /** What was put right while reading, one sentence each. */
  repairs: string[];
}

/** A number for each foot that is planted: [left, right]. */
export type EachFoot = readonly [number, number];

/** How a walker steps [Footsteps §3.3, user parameters]. */
export interface Gait {
  /** Mass-specific power at rest, W/kg [Footsteps eq. 14]. */
  power: number;
  /** Weight of the force that bends the way, 0.2 to 0.5 [Footsteps eq. 16]. */
  bend: number;
  /** Height of the pelvis, metres: leg of the pendulum. */
  leg: number;
  /** From the body's middle to a foot at rest, metres [Footsteps d of §3.2]. */
  footAside: number;
  /** Time on each planted foot at the speed wanted and when slower (or where that is slow), seconds, multiples of 0.1: unequal for one who limps. */
  quick: EachFoot;
  slow: EachFoot;
  /** Speed on each planted foot over the speed wanted: less on an injured leg. */
  pace: EachFoot;
  /** Farthest that consecutive footfalls are apart, and the widest turn of the parabola from the motion, metres, radians. */
  strideMost: number;
  mostTurn: number;
  /** Width of the interval of foot orientations that the foot before leaves open, radians [Footsteps eq. 12: pi / 2]. */
  yawRange: number;
  /** Radius of the visual field, and how far it reaches behind the back, metres. */
  sight: number;
  sightBehind: number;
}

export const DEFAULT_GAIT: Gait = {
  power: 2.23,
  bend: 0.35,
  leg: 0.9,
  footAside: 0.09,
  quick: [0.5, 0.5],
  slow: [0.6, 0.6],
  pace: [1, 1],
  strideMost: 1.1,
  mostTurn: 1.3,
  yawRange: Math.PI / 2,
  sight: 7,
  sightBehind: 2,
};

/** Slower than this people take longer steps in time, not only shorter ones, metres a second: 0.6 s at 0.9 m/s. */
const STROLL = 1.05;

/** Time on a planted foot, 0 left or 1 right, of one who walks at the speed wanted, seconds. */
export const stepTime = (gait: Gait, foot: 0 | 1, speed: number): number =>
  speed * gait.pace[foot] > STROLL ? gait.quick[foot] : gait.slow[foot];

/** An injured walker's gait: short, slow steps on the leg that hurts, 0 left or 1 right. */
export function limping(leg: 0 | 1): Partial<Gait> {
  const each = (hurt: number, well: number): EachFoot => (leg === 0 ? [hurt, well] : [well, hurt]);
  return { quick: each(0.4, 0.6), slow: each(0.5, 0.7), pace: each(0.7, 0.8), strideMost: 0.75 };
}

/**
 * Speed wanted where none is given: sqrt(g l Fr) with the Froude ratio of a usual walk, 0.25 [Footsteps §3.3].
 *
 * @param leg height of the pelvis, metres. @returns metres a second.
 */
export const froudeSpeed = (leg: number, ratio = 0.25): number => Math.sqrt(GRAVITY * leg * ratio);

/** Radius of torso and shoulder circles and the shoulders' way from the middle [Footsteps Figure 1c]. */
export const BODY_RADIUS = 0.15;
export const SHOULDER = 0.15;
export const FOOT_RADIUS = 0.08;
/** Planning and output happen on these ticks, seconds. */
export const TICK = 0.05;
