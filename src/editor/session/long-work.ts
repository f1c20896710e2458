/** Work that takes longer than a moment: shown with its progress after 200 ms, and given up when the user says so. */
import type { Editor } from "../editor.ts";

/** Milliseconds before progress is shown. */
const SOON = 200;

export class LongWork {
  private running: AbortController | null = null;

  constructor(private readonly e: Editor) {}

  /**
   * Runs one piece of work; what runs already is given up.
   *
   * @param act reports how far it is (0 to 1) with a fact such as "2 of 3", and heeds the signal.
   * @returns what `act` gives, or null when it was cancelled. @throws what `act` throws.
   */
  async run<T>(
    name: string,
    act: (report: (share: number, fact: string) => void, signal: AbortSignal) => Promise<T>,
  ): Promise<T | null> {
    this.cancel();
    const mine = new AbortController();
    this.running = mine;
    const begun = performance.now();
    try {
      return await act((share, fact) => {
        if (this.running === mine && performance.now() - begun > SOON)
          this.e.set({ progress: { name, share, fact } });
      }, mine.signal);
    } catch (error) {
      if (mine.signal.aborted) return null;
      throw error;
    } finally {
      if (this.running === mine) {
        this.running = null;
        this.e.set({ progress: null });
      }
    }
  }

  cancel(): void {
    this.running?.abort(new DOMException("cancelled", "AbortError"));
    this.running = null;
    this.e.set({ progress: null });
  }
}
