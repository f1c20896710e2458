/** A drawing context that the browser takes away: it may come back, and the picture is then drawn anew. */

/** Milliseconds after which a context that is lost counts as gone. */
const PATIENCE = 5000;

export interface ContextEvents {
  /** It is back, with everything that lay on the graphics card made anew at the next drawing. */
  back(): void;
  /** It has not come back in time; it may still. */
  gone(): void;
}

/**
 * Lets a canvas's lost context come back, which browsers do only where the loss has been dealt with.
 *
 * @returns what stops it.
 */
export function keepContext(canvas: EventTarget, events: ContextEvents): () => void {
  let waiting: ReturnType<typeof setTimeout> | undefined;
  const lost = (e: Event): void => {
    e.preventDefault();
    clearTimeout(waiting);
    waiting = setTimeout(() => events.gone(), PATIENCE);
  };
  const restored = (): void => {
    clearTimeout(waiting);
    events.back();
  };
  canvas.addEventListener("webglcontextlost", lost);
  canvas.addEventListener("webglcontextrestored", restored);
  return () => {
    clearTimeout(waiting);
    canvas.removeEventListener("webglcontextlost", lost);
    canvas.removeEventListener("webglcontextrestored", restored);
  };
}
