/**
 * How much a frame may cost: while frames come too slowly, shadows are drawn small and pixels large; a picture at rest is
 * always drawn in full.
 *
 * Begins sparing, so that the first picture comes soon, and grows once frames are quick.
 */

/** Milliseconds between frames above which drawing is spared, and below which it is full again. */
const SLOW = 45;
const QUICK = 24;
/** Frames in a row that decide. */
const SLOW_FRAMES = 3;
const QUICK_FRAMES = 8;
/** Frames farther apart than this were not asked for in a row. */
const APART = 700;
/** Milliseconds without a frame after which the picture is at rest. */
const REST = 1000;

export class FrameBudget {
  /** Whether frames are drawn sparingly now. */
  sparing = true;
  private last = Number.NEGATIVE_INFINITY;
  private slow = 0;
  private quick = 0;
  private timer = 0;

  /** @param rest called when nothing has been drawn for a while and the last picture was a sparing one. */
  constructor(private readonly rest: () => void) {}

  /** A frame begins at `now` milliseconds. @returns whether `sparing` has changed. */
  frame(now: number): boolean {
    const passed = now - this.last;
    this.last = now;
    const before = this.sparing;
    if (passed < APART) {
      this.slow = passed > SLOW ? this.slow + 1 : 0;
      this.quick = passed < QUICK ? this.quick + 1 : 0;
      if (this.slow >= SLOW_FRAMES) this.sparing = true;
      if (this.quick >= QUICK_FRAMES) this.sparing = false;
    }
    if (this.sparing) {
      window.clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.rest(), REST);
    }
    return before !== this.sparing;
  }

  dispose(): void {
    window.clearTimeout(this.timer);
  }
}
