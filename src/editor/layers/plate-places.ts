/** Where names on plates stand beside the places that they name: clear of each other, of handles, and inside the view. */

export interface PlateWish {
  /** The place that is named, pixels. */
  x: number;
  y: number;
  /** The side that it would rather stand on: 1 to the right, -1 to the left. */
  side: number;
  /** Width of the plate, pixels. */
  width: number;
}

export interface PlateRoom {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Height of a plate; room kept around it and around a handle's middle; pixels. */
export const PLATE_HEIGHT = 22;
const GAP = 4;
const HANDLE = 9;
/** Offsets of a plate's middle from its place, the best first: sideways to the wished side, down the screen. */
const OFFSETS: readonly (readonly [number, number])[] = [
  [34, -47],
  [-34, -47],
  [34, -80],
  [-34, -80],
  [34, 44],
  [-34, 44],
  [84, -47],
  [-84, -47],
  [0, -112],
  [0, 78],
];

/**
 * Places for plates, in their order: for each the first offset at which it meets nothing, or the one at which it meets least.
 *
 * @param handles middles of what must stay visible, pixels.
 * @returns offsets of the plates' middles from their places, pixels.
 */
export function placePlates(
  wishes: readonly PlateWish[],
  handles: readonly (readonly [number, number])[],
  room: PlateRoom,
): [number, number][] {
  const taken: [number, number, number][] = [];
  return wishes.map((w) => {
    const half = w.width / 2;
    let best: [number, number] = [0, 0];
    let least = Number.POSITIVE_INFINITY;
    for (const [sideways, down] of OFFSETS) {
      const x = Math.max(room.left + half + GAP, Math.min(room.right - half - GAP, w.x + w.side * sideways));
      const y = w.y + down;
      if (y - PLATE_HEIGHT / 2 < room.top || y + PLATE_HEIGHT / 2 > room.bottom) continue;
      const meets =
        taken.filter(
          ([tx, ty, th]) => Math.abs(x - tx) < half + th + GAP && Math.abs(y - ty) < PLATE_HEIGHT + GAP,
        ).length *
          2 +
        handles.filter(
          ([hx, hy]) => Math.abs(x - hx) < half + HANDLE && Math.abs(y - hy) < PLATE_HEIGHT / 2 + HANDLE,
        ).length;
      if (meets >= least) continue;
      least = meets;
      best = [x - w.x, down];
      if (meets === 0) break;
    }
    if (least === Number.POSITIVE_INFINITY) best = [w.side * OFFSETS[0][0], OFFSETS[0][1]];
    taken.push([w.x + best[0], w.y + best[1], half]);
    return best;
  });
}
