/**
 * How fine the stage is drawn: finest where it stands still, as fine as the machine keeps up with where it moves.
 *
 * Frames that follow each other are timed. While they take more than 20 ms, first the pixels are halved to one a CSS pixel, then
 * the shadow of the key light is left out (the soft blobs under feet and furniture stay), at last pixels are made larger. When
 * nothing has moved for a moment, one frame is drawn with everything. A software renderer begins at the coarse end: each of its
 * frames would take a second.
 */

/** Coarseness: 0 all of it, 1 one pixel a CSS pixel, 2 no cast shadow, 3 larger pixels. */
export type Coarseness = 0 | 1 | 2 | 3;

/** Milliseconds a frame from which on a coarser one is tried, and under which a finer one is. */
const SLOW = 20;
const QUICK = 9;
/** From which on pixels are made larger. */
const VERY_SLOW = 90;
/** Frames looked at before a change for the coarser or the finer. */
const FRAMES_SLOW = 6;
const FRAMES_QUICK = 240;
/** A gap this long is no frame but a rest, ms. */
const REST = 1000;

export class FramePace {
  private level: Coarseness;
  private last = 0;
  private mean = 0;
  private count = 0;

  /** @param software whether frames are drawn by the processor. */
  constructor(software: boolean) {
    this.level = software ? 2 : 0;
  }

  get coarseness(): Coarseness {
    return this.level;
  }

  /**
   * A frame is drawn while things move.
   *
   * @param now milliseconds, as requestAnimationFrame gives them.
   * @returns whether the coarseness has changed.
   */
  moved(now: number): boolean {
    const passed = now - this.last;
    this.last = now;
    if (passed <= 0 || passed > REST) {
      this.count = 0;
      return false;
    }
    this.mean = this.count === 0 ? passed : this.mean + (passed - this.mean) / Math.min(8, this.count + 1);
    this.count++;
    if (this.count >= FRAMES_SLOW && this.mean > SLOW && this.level < (this.mean > VERY_SLOW ? 3 : 2))
      return this.change(1);
    if (this.count >= FRAMES_QUICK && this.mean < QUICK && this.level > 0) return this.change(-1);
    return false;
  }

  private change(by: 1 | -1): boolean {
    this.level = Math.max(0, Math.min(3, this.level + by)) as Coarseness;
    this.count = 0;
    return true;
  }
}

/** Whether a WebGL context draws with the processor. */
export function drawsInSoftware(gl: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
