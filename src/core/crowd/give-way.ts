/** Two who wait for each other would wait for ever: how they get out of it. */
import { clearWay, type Ground } from "./ground.ts";
import { createStraightWay, type LongWay } from "./long-way.ts";
import type { Neighbours } from "./neighbours.ts";

/** Who has not come nearer to the goal for so long is stuck, seconds; and who stands face to face with somebody. */
export const STUCK_AFTER = 2.5;
const FACED_AFTER = 0.7;
/** Somebody this near, ahead, who wants to come the other way, is in the way, metres. */
const NEAR = 1.5;
/** Time in which one who makes room keeps to it, and in which ranks stay as they are, seconds. */
const CHOICE = 1.6;
const RANKS = 5;
/** Where one could make room, over the way to the goal: ahead, aside; and how far, metres. */
const ROOMS = [
  [-1, 0],
  [-0.7, 0.7],
  [-0.7, -0.7],
  [0, 1],
  [0, -1],
] as const;
const FAR = 1.6;

/** What is known of a walker's wish and whether it makes room. */
export interface Wish {
  /** Way it wants to go, unit. */
  aimX: number;
  aimZ: number;
  /** Makes room at a place until a time. */
  roomX: number;
  roomZ: number;
  roomUntil: number;
}

export const createWish = (): Wish => ({
  aimX: 0,
  aimZ: 0,
  roomX: 0,
  roomZ: 0,
  roomUntil: -1,
});

const room: LongWay = createStraightWay(0, 0);

/** A small integer hash: the same everywhere. */
const hash = (agent: number, turn: number): number =>
  (Math.imul(agent * 73 + turn * 151 + 7, 2654435761) >>> 12) & 0xffff;

/**
 * A way aside for one who should make room: who stands face to face with somebody of higher rank, or has not come on for long. Ranks
 * are drawn anew every few seconds.
 *
 * @param waited seconds since it last came nearer. @param count of `neighbours.seen`.
 * @returns a way, valid until the next call; null for one who goes on.
 */
export function giveWay(
  ground: Ground,
  wishes: readonly Wish[],
  neighbours: Neighbours,
  count: number,
  agent: number,
  time: number,
  waited: number,
  x: number,
  z: number,
): LongWay | null {
  const wish = wishes[agent];
  if (
    time < wish.roomUntil &&
    (time < wish.roomUntil - CHOICE / 2 || opponent(wishes, neighbours, count, agent, x, z) >= 0)
  ) {
    room.goalX = wish.roomX;
    room.goalZ = wish.roomZ;
    return room;
  }
  if (waited < FACED_AFTER) return null;
  const facing = opponent(wishes, neighbours, count, agent, x, z);
  const turn = Math.floor(time / RANKS);
  if (facing >= 0) {
    const mine = hash(agent, turn);
    const theirs = hash(facing, turn);
    if (mine > theirs || (mine === theirs && agent > facing)) return null;
  } else if (waited < STUCK_AFTER || !crowded(neighbours, count, x, z)) return null;
  // By the clock, not by how long one has waited: who makes room begins to wait anew, and would draw the same for ever.
  else if (hash(agent, Math.floor(time / CHOICE)) % 3 !== 0) return null;
  findRoom(ground, wishes, neighbours, count, agent, facing, x, z);
  wish.roomUntil = time + CHOICE;
  room.goalX = wish.roomX;
  room.goalZ = wish.roomZ;
  return room;
}

/** Whether anybody is near enough to make room for: who has strayed alone only has to turn back. */
function crowded(neighbours: Neighbours, count: number, x: number, z: number): boolean {
  for (let n = 0; n < count; n++) {
    const k = neighbours.seen[n];
    const dx = neighbours.places[2 * k] - x;
    const dz = neighbours.places[2 * k + 1] - z;
    if (dx * dx + dz * dz < NEAR * NEAR) return true;
  }
  return false;
}

/** The nearest walker ahead that wants to come this way; -1 when there is none. */
function opponent(
  wishes: readonly Wish[],
  neighbours: Neighbours,
  count: number,
  agent: number,
  x: number,
  z: number,
): number {
  const { aimX, aimZ } = wishes[agent];
  for (let n = 0; n < count; n++) {
    const k = neighbours.seen[n];
    const dx = neighbours.places[2 * k] - x;
    const dz = neighbours.places[2 * k + 1] - z;
    const d = Math.sqrt(dx * dx + dz * dz);
    if (d > NEAR) continue;
    if (dx * aimX + dz * aimZ < 0.4 * d) continue;
    if (-(dx * wishes[k].aimX + dz * wishes[k].aimZ) > 0.4 * d) return k;
  }
  return -1;
}

/**
 * Whether one walker goes before another that wants the same way: the one that is farther along it. Of two, never both.
 *
 * @param dx, dz from the walker to the other.
 */
export function goesFirst(
  wishes: readonly Wish[],
  agent: number,
  other: number,
  dx: number,
  dz: number,
): boolean {
  const a = wishes[agent];
  const b = wishes[other];
  if (a.aimX * b.aimX + a.aimZ * b.aimZ < 0) return false;
  return dx * (a.aimX + b.aimX) + dz * (a.aimZ + b.aimZ) > 0;
}

/** Notes the best place to make room at: free of walls and others, and off the other's way. */
function findRoom(
  ground: Ground,
  wishes: readonly Wish[],
  neighbours: Neighbours,
  count: number,
  agent: number,
  facing: number,
  x: number,
  z: number,
): void {
  const wish = wishes[agent];
  let best = Number.NEGATIVE_INFINITY;
  for (let r = 0; r < ROOMS.length; r++) {
    const [back, side] = ROOMS[r];
    for (let f = 1; f <= 2; f++) {
      const far = (FAR * f) / 2;
      const px = x + far * (back * wish.aimX + side * wish.aimZ);
      const pz = z + far * (back * wish.aimZ - side * wish.aimX);
      // Before others places are drawn in turn, so that two do not go back and forth together.
      let worth = (hash(agent + 17 * r, Math.floor(x * 8)) & 15) * 0.02 - 0.1 * f;
      if (!clearWay(ground, x, z, px, pz, 1)) worth -= 3;
      for (let n = 0; n < count; n++) {
        const k = neighbours.seen[n];
        const dx = neighbours.places[2 * k] - px;
        const dz = neighbours.places[2 * k + 1] - pz;
        const d2 = dx * dx + dz * dz;
        if (d2 < 0.7) worth -= 1 - d2 / 0.7;
        if (k !== facing) continue;
        const { aimX, aimZ } = wishes[k];
        if (-dx * aimX - dz * aimZ < 0) continue;
        const off = Math.abs(dx * aimZ - dz * aimX);
        if (off < 0.8) worth -= 1.2 * (1 - off / 0.8);
      }
      if (worth <= best) continue;
      best = worth;
      wish.roomX = px;
      wish.roomZ = pz;
    }
  }
}
