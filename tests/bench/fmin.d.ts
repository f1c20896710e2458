declare module "fmin" {
  const fmin: {
    /** Minimises f(x, gradient) from a start by nonlinear conjugate gradients. */
    conjugateGradient(
      f: (x: number[], gradient?: number[]) => number,
      initial: number[],
      params?: { maxIterations?: number; history?: unknown[] },
    ): { x: number[]; fx: number; fxprime: number[] };
  };
  export default fmin;
}
