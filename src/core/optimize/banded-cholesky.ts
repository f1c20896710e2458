/** Cholesky of a symmetric positive band matrix in place, and the solve with it: O(n b^2) and O(n b). */

/**
 * Factors A = L L^T. `band` row r holds A(r, r - k) at [r width + k]; L takes its place. A pivot under `floor` is raised
 * to it (the direction stays one of descent).
 */
export function factorBand(band: Float64Array, n: number, width: number, floor: number): void {
  for (let r = 0; r < n; r++) {
    const rb = r * width;
    const kMax = Math.min(width - 1, r);
    for (let k = kMax; k >= 0; k--) {
      const c = r - k;
      const cb = c * width;
      let sum = band[rb + k];
      const jMax = Math.min(width - 1 - k, c);
      for (let j = 1; j <= jMax; j++) sum -= band[rb + k + j] * band[cb + j];
      if (k === 0) band[rb] = Math.sqrt(Math.max(sum, floor));
      else band[rb + k] = sum / band[cb];
    }
  }
}

/** Solves L L^T x = b in place. */
export function solveBand(band: Float64Array, n: number, width: number, b: Float64Array): void {
  for (let r = 0; r < n; r++) {
    const rb = r * width;
    let sum = b[r];
    const kMax = Math.min(width - 1, r);
    for (let k = 1; k <= kMax; k++) sum -= band[rb + k] * b[r - k];
    b[r] = sum / band[rb];
  }
  for (let r = n - 1; r >= 0; r--) {
    let sum = b[r];
    const kMax = Math.min(width - 1, n - 1 - r);
    for (let k = 1; k <= kMax; k++) sum -= band[(r + k) * width + k] * b[r + k];
    b[r] = sum / band[r * width];
  }
}
