/**
 * Where a foot must rest: one place for the heel and one for the ball and tip of every plant, and how far the captured foot is
 * from them in each frame [Kovar et al. 2002, §4; Oracle §7]. Ground plane only: heights are the capture's.
 */

/** Ground places of a foot's heel, ball and tip and the height of its ball, a frame. */
export interface FootPath {
  frames: number;
  /** frames x 6: heel, ball, tip as pairs on the ground. */
  ground: Float64Array;
  /** Ankle's ground place, frames x 2. */
  ankle: Float64Array;
  ballHeight: Float64Array;
  heel: Uint8Array;
  toe: Uint8Array;
}

/** Correction of a foot: turn about the upright through its ankle (radians, from the first ground axis to the second), then a move. */
export interface FootCorrection {
  turn: Float64Array;
  /** frames x 2. */
  move: Float64Array;
}

/** Height of the ball over its resting height at which the tip has taken over, metres. */
const ROLLED = 0.018;
const ROLLS = 0.006;

const smooth = (u: number): number => {
  const t = Math.max(0, Math.min(1, u));
  return t * t * (3 - 2 * t);
};

/**
 * The corrections of one foot.
 *
 * @param blend frames in which a correction comes and goes where no plant is [Oracle §7: 30 frames at 60 Hz].
 */
export function correctFoot(path: FootPath, blend: number, handOver: number): FootCorrection {
  const n = path.frames;
  const out: FootCorrection = { turn: new Float64Array(n), move: new Float64Array(2 * n) };
  const plants: [number, number][] = [];
  for (let f = 0; f < n; ) {
    if (!path.heel[f] && !path.toe[f]) {
      f++;
      continue;
    }
    let end = f;
    while (end < n && (path.heel[end] || path.toe[end])) end++;
    plants.push([f, end]);
    correctPlant(path, f, end, out, handOver);
    f = end;
  }
  for (let i = 0; i <= plants.length; i++) {
    const from = i > 0 ? plants[i - 1][1] : 0;
    const to = i < plants.length ? plants[i][0] : n;
    for (let f = from; f < to; f++) {
      const sinceLast = f - from + 1;
      const toNext = to - f;
      const gap = to - from + 1;
      const length = Math.min(blend, gap);
      // A gap that is shorter than both blends is one blend from the last to the next.
      const s = gap < 2 * blend ? smooth(sinceLast / gap) : 0;
      const last =
        i === 0 ? 0 : gap < 2 * blend && i < plants.length ? 1 - s : 1 - smooth(sinceLast / length);
      const next = i === plants.length ? 0 : gap < 2 * blend && i > 0 ? s : 1 - smooth(toNext / length);
      const a = Math.max(0, from - 1);
      const b = Math.min(n - 1, to);
      out.turn[f] = (i > 0 ? last * out.turn[a] : 0) + (i < plants.length ? next * out.turn[b] : 0);
      for (let k = 0; k < 2; k++)
        out.move[2 * f + k] =
          (i > 0 ? last * out.move[2 * a + k] : 0) + (i < plants.length ? next * out.move[2 * b + k] : 0);
    }
  }
  return out;
}

function correctPlant(
  path: FootPath,
  first: number,
  end: number,
  out: FootCorrection,
  handOver: number,
): void {
  const { ground, heel, toe } = path;
  const target = new Float64Array(6);
  const count = new Float64Array(3);
  let dx = 0;
  let dz = 0;
  let flats = 0;
  let low = Number.POSITIVE_INFINITY;
  for (let f = first; f < end; f++) {
    const both = heel[f] && toe[f];
    if (both) {
      const o = 6 * f;
      const l = Math.hypot(ground[o + 2] - ground[o], ground[o + 3] - ground[o + 1]) || 1;
      dx += (ground[o + 2] - ground[o]) / l;
      dz += (ground[o + 3] - ground[o + 1]) / l;
      flats++;
    }
    if (toe[f]) low = Math.min(low, path.ballHeight[f]);
  }
  const flat = flats >= 2;
  for (let f = first; f < end; f++) {
    const both = heel[f] && toe[f];
    for (let p = 0; p < 3; p++) {
      if (flat ? !both : !(p === 0 ? heel[f] : toe[f])) continue;
      target[2 * p] += ground[6 * f + 2 * p];
      target[2 * p + 1] += ground[6 * f + 2 * p + 1];
      count[p]++;
    }
  }
  for (let p = 0; p < 3; p++) {
    const c = Math.max(1, count[p]);
    target[2 * p] /= c;
    target[2 * p + 1] /= c;
  }
  const length = Math.hypot(dx, dz) || 1;
  const ux = dx / length;
  const uz = dz / length;
  if (flat) {
    // Heel, ball and tip on one line through the foot's mean place, at their mean distances.
    const cx = (target[0] + target[2]) / 2;
    const cz = (target[1] + target[3]) / 2;
    for (let p = 0; p < 3; p++) {
      const along = (target[2 * p] - cx) * ux + (target[2 * p + 1] - cz) * uz;
      const across = (target[2 * p] - cx) * -uz + (target[2 * p + 1] - cz) * ux;
      target[2 * p] = cx + along * ux - across * uz;
      target[2 * p + 1] = cz + along * uz + across * ux;
    }
    for (let f = first; f < end; f++) {
      if (!(heel[f] && toe[f])) continue;
      const o = 6 * f;
      const ax = ground[o + 2] - ground[o];
      const az = ground[o + 3] - ground[o + 1];
      const bx = target[2] - target[0];
      const bz = target[3] - target[1];
      out.turn[f] = Math.atan2(ax * bz - az * bx, ax * bx + az * bz);
    }
    // Before and after it lies flat the foot keeps the nearest flat frame's turn.
    let held = Number.NaN;
    for (let f = first; f < end; f++) {
      if (heel[f] && toe[f]) held = out.turn[f];
      else if (!Number.isNaN(held)) out.turn[f] = held;
    }
    held = Number.NaN;
    for (let f = end - 1; f >= first; f--) {
      if (heel[f] && toe[f]) held = out.turn[f];
      else if (!Number.isNaN(held) && !hasFlatBefore(path, first, f)) out.turn[f] = held;
    }
  }
  let onToe = 0;
  for (let f = first; f < end; f++) {
    const c = Math.cos(out.turn[f]);
    const s = Math.sin(out.turn[f]);
    const off = (p: number, k: 0 | 1): number => {
      const x = ground[6 * f + 2 * p] - path.ankle[2 * f];
      const z = ground[6 * f + 2 * p + 1] - path.ankle[2 * f + 1];
      const turned = k === 0 ? c * x - s * z : s * x + c * z;
      return target[2 * p + k] - path.ankle[2 * f + k] - turned;
    };
    // The bearing point goes over from heel to toe within a few frames of lying flat.
    if (toe[f]) onToe = heel[f] ? Math.min(1, onToe + 1 / handOver) : 1;
    else onToe = Math.max(0, onToe - 1 / handOver);
    const first_ = f === first && toe[f] && !heel[f];
    const w = first_ ? 1 : heel[f] && !toe[f] && f === first ? 0 : smooth(onToe);
    const rolled = smooth((path.ballHeight[f] - low - ROLLS) / (ROLLED - ROLLS));
    for (let k = 0 as 0 | 1; k < 2; k = (k + 1) as 0 | 1) {
      const onBall = off(1, k) + rolled * (off(2, k) - off(1, k));
      out.move[2 * f + k] = heel[f] && !toe[f] ? off(0, k) : (1 - w) * off(0, k) + w * onBall;
    }
  }
}

function hasFlatBefore(path: FootPath, first: number, f: number): boolean {
  for (let g = first; g < f; g++) if (path.heel[g] && path.toe[g]) return true;
  return false;
}
