/** How labels compare with truth: the measures of the contact tables. */

export interface ContactScore {
  right: number;
  all: number;
  /** The same without two frames on each side of a true boundary. */
  rightAway: number;
  allAway: number;
  matched: number;
  found: number;
  true: number;
  /** Plants under three frames that the clip's ends do not cut. */
  flickers: number;
}

export const emptyScore = (): ContactScore => ({
  right: 0,
  all: 0,
  rightAway: 0,
  allAway: 0,
  matched: 0,
  found: 0,
  true: 0,
  flickers: 0,
});

export function addScore(to: ContactScore, labels: Uint8Array, truth: Uint8Array): void {
  const n = truth.length;
  for (let b = 0; b < 4; b++) {
    const p = Uint8Array.from(labels, (x) => (x >> b) & 1);
    const t = Uint8Array.from(truth, (x) => (x >> b) & 1);
    const near = new Uint8Array(n);
    for (let i = 1; i < n; i++) if (t[i] !== t[i - 1]) near.fill(1, Math.max(0, i - 2), Math.min(n, i + 2));
    for (let i = 0; i < n; i++) {
      to.all++;
      if (p[i] === t[i]) to.right++;
      if (near[i]) continue;
      to.allAway++;
      if (p[i] === t[i]) to.rightAway++;
    }
    const found = runs(p);
    const real = runs(t);
    const pairs: [number, number, number][] = [];
    found.forEach(([a, z], i) => {
      real.forEach(([c, e], j) => {
        const share = (Math.min(z, e) - Math.max(a, c)) / (Math.max(z, e) - Math.min(a, c));
        if (share > 0.5) pairs.push([share, i, j]);
      });
    });
    pairs.sort((x, y) => y[0] - x[0]);
    const usedFound = new Set<number>();
    const usedReal = new Set<number>();
    for (const [, i, j] of pairs) {
      if (usedFound.has(i) || usedReal.has(j)) continue;
      usedFound.add(i);
      usedReal.add(j);
    }
    to.matched += usedFound.size;
    to.found += found.length;
    to.true += real.length;
    for (const [a, z] of found) if (z - a < 3 && a > 0 && z < n) to.flickers++;
  }
}

function runs(bit: Uint8Array): [number, number][] {
  const out: [number, number][] = [];
  let from = -1;
  for (let i = 0; i <= bit.length; i++) {
    if (i < bit.length && bit[i]) {
      if (from < 0) from = i;
    } else if (from >= 0) {
      out.push([from, i]);
      from = -1;
    }
  }
  return out;
}
