/** Contacts as text: `frame,left_heel,left_toe,right_heel,right_toe`, one row a frame. */
import type { ContactTrack } from "../steps/types.ts";

const HEAD = "frame,left_heel,left_toe,right_heel,right_toe";

/** The rows of a track at `rate`, one for each of `frames` frames at the source's own rate. */
export function contactsCsv(track: ContactTrack, rate: number, sourceRate: number, frames: number): string {
  const rows = [HEAD];
  for (let f = 0; f < frames; f++) {
    const i = Math.max(0, Math.min(track.length - 1, Math.round((f * rate) / sourceRate)));
    const c = track[i];
    rows.push(`${f},${c & 1},${(c >> 1) & 1},${(c >> 2) & 1},${(c >> 3) & 1}`);
  }
  return `${rows.join("\n")}\n`;
}

/** A track from text. @throws Error "F, line 3: ..." */
export function parseContactsCsv(text: string, name: string): ContactTrack {
  const lines = text.split(/\r?\n/).filter((l, i, all) => l.trim() !== "" || i < all.length - 1);
  if (lines[0]?.trim() !== HEAD) throw new Error(`${name}, line 1: ${HEAD} is needed.`);
  const out = new Uint8Array(lines.length - 1);
  for (let i = 1; i < lines.length; i++) {
    const cells = lines[i].split(",").map((c) => c.trim());
    if (cells.length !== 5) throw new Error(`${name}, line ${i + 1}: ${cells.length} columns, 5 expected.`);
    if (Number(cells[0]) !== i - 1)
      throw new Error(`${name}, line ${i + 1}: frame ${i - 1} is expected, found ${cells[0]}.`);
    for (let b = 0; b < 4; b++) {
      if (cells[b + 1] !== "0" && cells[b + 1] !== "1")
        throw new Error(`${name}, line ${i + 1}: 0 or 1 is needed, found ${cells[b + 1]}.`);
      if (cells[b + 1] === "1") out[i - 1] |= 1 << b;
    }
  }
  return out;
}
