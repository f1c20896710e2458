/** Seeded random numbers: the same sequence in every engine (32-bit integer arithmetic only). */

export interface Random {
  /** Uniform in [0, 1). */
  next(): number;
  /** Uniform in [low, high). */
  between(low: number, high: number): number;
  /** Standard normal, clipped at +-3. */
  normal(): number;
  /** Uniform integer in [0, n). */
  below(n: number): number;
}

/** mulberry32 [Tommy Ettinger, public domain]. */
export function createRandom(seed: number): Random {
  let a = (seed ^ 0x9e3779b9) >>> 0;
  const next = () => {
    a = (a + 0x6d2b79f5) >>> 0;
    let t = a;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  return {
    next,
    between: (low, high) => low + (high - low) * next(),
    // Sum of twelve uniforms: no transcendental function, so bits agree everywhere.
    normal: () => {
      let s = -6;
      for (let i = 0; i < 12; i++) s += next();
      return Math.max(-3, Math.min(3, s));
    },
    below: (n) => Math.floor(next() * n),
  };
}
