/** Files out and in: one entry a format; the Export menu, the file picker and dropping read these lists. */
import type { Editor } from "../editor.ts";

export interface ExportFormat {
  id: string;
  /** As the menu shows it: "Motion, BVH at 60 Hz". */
  label: string;
  /** File name with its ending. */
  file: string;
  type: string;
  /** Place in the menu; groups are hundreds. */
  order: number;
  /** A key of `keys.ts` shown beside it. */
  shortcut?: string;
  /** Why it cannot be made now, as one sentence; null when it can. */
  blocked?(e: Editor): string | null;
  make(e: Editor): string | Blob | Promise<string | Blob>;
}

export interface ImportFormat {
  id: string;
  /** "Scene" */
  label: string;
  /** Endings with their dot, lower case. */
  endings: readonly string[];
  /** Whether a file with one of the endings is of this format, where several share an ending; left out: yes. */
  accepts?(file: File): boolean | Promise<boolean>;
  /** Opens files that end so, all at once. @throws Error with one sentence that begins with the file's name. */
  open(e: Editor, files: readonly File[]): Promise<void>;
}
