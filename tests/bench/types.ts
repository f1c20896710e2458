/** A figure of `npm run bench`: one line of `bench --json`. */
export interface Figure {
  name: string;
  unit: string;
  median: number;
  min: number;
  max: number;
  /** How many measurements the median is of. */
  n: number;
  /** What it is compared with in the same run; null when with nothing. */
  peer: string | null;
  peerMedian: number | null;
  /** median / peerMedian, or null. */
  ratio: number | null;
  /** The goal in words, e.g. "ratio <= 0.7" or "<= 50 ms". */
  goal: string | null;
  ok: boolean | null;
  /** The size that it was measured at, for plots of cost against size. */
  size?: number;
}

export interface BenchOptions {
  instances: string | null;
  reference: string | null;
  out: string | null;
  progress(message: string): void;
}

/** A file `tests/bench/NAME.bench.ts` exports one of these as its default. */
export interface BenchModule {
  name: string;
  run(options: BenchOptions): Promise<Figure[]>;
  /** Plots of its own beside the bars, by file name without `.svg`: SVG markup from what was measured. */
  plots?(figures: readonly Figure[]): Record<string, string>;
}
