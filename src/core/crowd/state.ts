/** Walkers' states and steps as numbers in flat arrays: offsets and what they mean. */

/** Numbers of a state. */
export const STATE = 17;
/**
 * Offsets of a state at the end of a step [Footsteps eq. 10]: middle of mass; direction of motion (unit) and speed; side of
 * the foot that comes next (1 left); last foot's place; facing of the torso and heading of the feet (unit); time; the last
 * parabola's angle to the motion and its foot's yaw interval [Footsteps eq. 12].
 */
export const S = {
  x: 0,
  z: 1,
  ux: 2,
  uz: 3,
  speed: 4,
  side: 5,
  footX: 6,
  footZ: 7,
  faceX: 8,
  faceZ: 9,
  headX: 10,
  headZ: 11,
  time: 12,
  theta: 13,
  inner: 14,
  outer: 15,
} as const;

/** What a step is: stands; walks a parabola; comes to a stop; starts from rest; shifts both feet, from rest to rest. */
export const KIND = { stand: 0, walk: 1, stop: 2, start: 3, shift: 4 } as const;

/** Numbers of a step. */
export const STEP = 30;
/**
 * Offsets of a step: its kind and times; middle of mass at its start; the parabola's direction (unit); speed along it (start:
 * at its end; shift: metres moved) and towards the foot at its start; the planted foot's side and place (shift: that of the foot that
 * lands first); torso's facing before and after; heading of the feet before and after; the foot's yaw interval, outwards of
 * the parabola, and the angle between motion and parabola; energies of eqs. 14, 15, 16 and what nearness to others adds, J/kg.
 */
export const P = {
  kind: 0,
  start: 1,
  duration: 2,
  x: 3,
  z: 4,
  px: 5,
  pz: 6,
  along: 7,
  toFoot: 8,
  side: 9,
  footX: 10,
  footZ: 11,
  fromX: 12,
  fromZ: 13,
  toX: 14,
  toZ: 15,
  fromHeadX: 16,
  fromHeadZ: 17,
  headX: 18,
  headZ: 19,
  inner: 20,
  outer: 21,
  theta: 22,
  yaw: 23,
  fixedEnergy: 24,
  speedEnergy: 25,
  bendEnergy: 26,
  nearness: 27,
} as const;

/** Numbers of a pose: middle of mass, facing (unit), the foot that stands out most. */
export const POSE = 6;
