/** Runs of one value in a contact bit. */

/** Runs of `value` shorter than `shortest` that touch neither end take the other value. */
export function dropShort(track: Uint8Array, value: 0 | 1, shortest: number): void {
  let from = 0;
  for (let f = 1; f <= track.length; f++) {
    if (f < track.length && track[f] === track[from]) continue;
    if (track[from] === value && f - from < shortest && from > 0 && f < track.length)
      track.fill(1 - value, from, f);
    from = f;
  }
}
