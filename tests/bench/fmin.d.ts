declare module "fmin/index.js" {
  /** Minimises f(x, gradient) from a start by nonlinear conjugate gradients. */
  export function conjugateGradient(
    f: (x: number[], gradient?: number[]) => number,
    initial: number[],
    params?: { maxIterations?: number; history?: unknown[] },
  ): { x: number[]; fx: number; fxprime: number[] };
}
