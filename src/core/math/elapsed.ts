/** The time that a clock on a page goes on by from one frame to the next. */

/** Seconds that a frame may add at most: a tab that was hidden goes on where it was and does not catch up. */
const MOST = 0.1;

/**
 * Seconds from one reading of the page's clock to the next, both in milliseconds, between 0 and a tenth: a clock that jumps back, or far
 * ahead, moves nothing back and nothing far.
 */
export const elapsed = (before: number, now: number): number =>
  Math.max(0, Math.min(MOST, (now - before) / 1000));
