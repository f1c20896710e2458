/**
 * BFGS in its limited-memory form [Nocedal and Wright 2006, algorithms 7.4 and 7.5], with a line search that keeps the
 * strong Wolfe conditions [ibid., algorithms 3.5 and 3.6].
 *
 * CONTRIBUTOR NOTES. The first inverse Hessian is the caller's (`precondition`): for footsteps a banded Gauss-Newton
 * factor, with which a handful of updates suffice. Dense updates cost O(n^2) each and lose from eight steps on.
 */

export type Objective = (x: Float64Array, grad: Float64Array) => number;

export interface BfgsOptions {
  /** Stops where the largest gradient entry is at most this. */
  gradientTolerance?: number;
  maxIterations?: number;
  /** Applies the first inverse Hessian to `v` in place; the identity (scaled) when left out. */
  precondition?: (v: Float64Array) => void;
  /** Called after every iteration. */
  onIteration?: (x: Float64Array, f: number) => void;
}

export interface BfgsResult {
  /** `stalled`: no step along the last direction lowers f any more. */
  status: "converged" | "stalled" | "iterations";
  f: number;
  iterations: number;
  evaluations: number;
}

const MEMORY = 8;
/** Sufficient decrease and curvature of the Wolfe conditions. */
const C1 = 1e-4;
const C2 = 0.9;

export interface BfgsWorkspace {
  capacity: number;
  grad: Float64Array;
  direction: Float64Array;
  trialX: Float64Array;
  trialGrad: Float64Array;
  s: Float64Array[];
  y: Float64Array[];
  rho: Float64Array;
  alpha: Float64Array;
}

/** Room for up to `capacity` variables; reused over calls. */
export function createBfgsWorkspace(capacity: number): BfgsWorkspace {
  const make = () => new Float64Array(capacity);
  return {
    capacity,
    grad: make(),
    direction: make(),
    trialX: make(),
    trialGrad: make(),
    s: Array.from({ length: MEMORY }, make),
    y: Array.from({ length: MEMORY }, make),
    rho: new Float64Array(MEMORY),
    alpha: new Float64Array(MEMORY),
  };
}

function dot(a: Float64Array, b: Float64Array, n: number): number {
  let sum = 0;
  for (let i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

function largest(a: Float64Array, n: number): number {
  let m = 0;
  for (let i = 0; i < n; i++) {
    const v = a[i] < 0 ? -a[i] : a[i];
    if (v > m) m = v;
  }
  return m;
}

/**
 * Minimises an objective from `x` (written). Not converging is a status.
 *
 * @param n number of variables, at most the workspace's capacity.
 */
export function minimiseBfgs(
  objective: Objective,
  x: Float64Array,
  n: number,
  w: BfgsWorkspace,
  options: BfgsOptions = {},
): BfgsResult {
  const tolerance = options.gradientTolerance ?? 1e-6;
  const most = options.maxIterations ?? 200;
  const { grad, direction: d, trialX, trialGrad } = w;
  let f = objective(x, grad);
  let evaluations = 1;
  let stored = 0;
  let head = 0;
  for (let iteration = 0; iteration < most; iteration++) {
    if (largest(grad, n) <= tolerance) return { status: "converged", f, iterations: iteration, evaluations };
    twoLoop(w, n, stored, head, options.precondition);
    let slope = dot(d, grad, n);
    if (!(slope < 0)) {
      // A history that misleads is dropped.
      stored = 0;
      for (let i = 0; i < n; i++) d[i] = -grad[i];
      slope = dot(d, grad, n);
    }
    const first =
      stored === 0 && !options.precondition ? Math.min(1, 1 / Math.max(1e-12, largest(grad, n))) : 1;
    const search = lineSearch(objective, x, f, slope, n, first, w);
    evaluations += search.evaluations;
    if (search.step === 0) {
      if (stored > 0) {
        stored = 0;
        continue;
      }
      return { status: "stalled", f, iterations: iteration, evaluations };
    }
    const slot = head;
    const s = w.s[slot];
    const y = w.y[slot];
    for (let i = 0; i < n; i++) {
      s[i] = trialX[i] - x[i];
      y[i] = trialGrad[i] - grad[i];
      x[i] = trialX[i];
      grad[i] = trialGrad[i];
    }
    const before = f;
    f = search.f;
    const sy = dot(s, y, n);
    if (sy > 1e-14) {
      w.rho[slot] = 1 / sy;
      head = (head + 1) % MEMORY;
      stored = Math.min(MEMORY, stored + 1);
    }
    options.onIteration?.(x, f);
    if (before - f <= 1e-15 * Math.max(1, Math.abs(f)) && largest(grad, n) <= 100 * tolerance) {
      return { status: "converged", f, iterations: iteration + 1, evaluations };
    }
  }
  return { status: "iterations", f, iterations: most, evaluations };
}

/** d = -H grad by the two-loop recursion. */
function twoLoop(
  w: BfgsWorkspace,
  n: number,
  stored: number,
  head: number,
  precondition: BfgsOptions["precondition"],
): void {
  const d = w.direction;
  for (let i = 0; i < n; i++) d[i] = -w.grad[i];
  for (let k = 1; k <= stored; k++) {
    const slot = (head - k + MEMORY) % MEMORY;
    const s = w.s[slot];
    const y = w.y[slot];
    const a = w.rho[slot] * dot(s, d, n);
    w.alpha[slot] = a;
    for (let i = 0; i < n; i++) d[i] -= a * y[i];
  }
  if (precondition) precondition(d);
  else if (stored > 0) {
    const slot = (head - 1 + MEMORY) % MEMORY;
    const scale = 1 / (w.rho[slot] * dot(w.y[slot], w.y[slot], n));
    for (let i = 0; i < n; i++) d[i] *= scale;
  }
  for (let k = stored; k >= 1; k--) {
    const slot = (head - k + MEMORY) % MEMORY;
    const s = w.s[slot];
    const b = w.rho[slot] * dot(w.y[slot], d, n);
    const a = w.alpha[slot] - b;
    for (let i = 0; i < n; i++) d[i] += a * s[i];
  }
}

const outcome = { step: 0, f: 0, evaluations: 0 };

/** Strong Wolfe step along w.direction: leaves x + step d in trialX and its gradient in trialGrad. Step 0: none found. */
function lineSearch(
  objective: Objective,
  x: Float64Array,
  f0: number,
  slope0: number,
  n: number,
  first: number,
  w: BfgsWorkspace,
): typeof outcome {
  const { direction: d, trialX, trialGrad } = w;
  let evaluations = 0;
  const probe = (t: number) => {
    for (let i = 0; i < n; i++) trialX[i] = x[i] + t * d[i];
    evaluations++;
    return objective(trialX, trialGrad);
  };
  let low = 0;
  let fLow = f0;
  let slopeLow = slope0;
  let high = 0;
  let fHigh = 0;
  let slopeHigh = 0;
  let bracketed = false;
  let t = first;
  for (let k = 0; k < 30; k++) {
    const f = probe(t);
    const slope = dot(trialGrad, d, n);
    if (!(f <= f0 + C1 * t * slope0) || (bracketed && f >= fLow)) {
      high = t;
      fHigh = f;
      slopeHigh = slope;
      bracketed = true;
    } else {
      if (Math.abs(slope) <= -C2 * slope0) {
        outcome.step = t;
        outcome.f = f;
        outcome.evaluations = evaluations;
        return outcome;
      }
      if (bracketed ? slope * (high - low) >= 0 : slope >= 0) {
        high = low;
        fHigh = fLow;
        slopeHigh = slopeLow;
        bracketed = true;
      }
      low = t;
      fLow = f;
      slopeLow = slope;
    }
    if (!bracketed) {
      t *= 2.5;
      continue;
    }
    if (Math.abs(high - low) * Math.abs(slope0) < 1e-16 * Math.max(1, Math.abs(f0))) break;
    t = cubicMinimum(low, fLow, slopeLow, high, fHigh, slopeHigh);
  }
  if (low > 0) {
    outcome.f = probe(low);
    outcome.step = outcome.f < f0 ? low : 0;
  } else outcome.step = 0;
  outcome.evaluations = evaluations;
  return outcome;
}

/** Minimum of the cubic through both ends, kept 10 % inside [Nocedal and Wright, eq. 3.59]; the middle when it has none. */
function cubicMinimum(a: number, fa: number, ga: number, b: number, fb: number, gb: number): number {
  const d1 = ga + gb - (3 * (fa - fb)) / (a - b);
  const square = d1 * d1 - ga * gb;
  let t = (a + b) / 2;
  if (square >= 0 && Number.isFinite(fb)) {
    const d2 = Math.sign(b - a) * Math.sqrt(square);
    const denominator = gb - ga + 2 * d2;
    if (denominator !== 0) t = b - ((b - a) * (gb + d2 - d1)) / denominator;
  }
  const inside = 0.1 * (b - a);
  const l = Math.min(a + inside, b - inside);
  const h = Math.max(a + inside, b - inside);
  return t >= l && t <= h ? t : t < l ? l : t > h ? h : (a + b) / 2;
}
