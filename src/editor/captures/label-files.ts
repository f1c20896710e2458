/** Labels of a capture as CSV, one row for every frame of its file. */
import { contactsCsv, parseContactsCsv } from "../../core/contacts/csv.ts";
import type { Capture } from "./capture.ts";

export const csvOf = (c: Capture): string =>
  contactsCsv(c.edits.labels, c.clip.rate, c.report.rate, c.report.frames);

/** Labels at the clip's rate. @throws Error that names the file: broken rows, or labels of another clip. */
export function labelsOfCsv(c: Capture, text: string, name: string): Uint8Array {
  const rows = parseContactsCsv(text, name);
  if (rows.length !== c.report.frames)
    throw new Error(
      `${name}: ${rows.length} rows, ${c.report.frames} frames in ${c.name}: these are labels of another clip.`,
    );
  return Uint8Array.from(
    { length: c.edits.frames },
    (_, f) => rows[Math.min(rows.length - 1, Math.round((f * c.report.rate) / c.clip.rate))],
  );
}
