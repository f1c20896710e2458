/** A straight sample dropped as BVH while a path is at hand: it becomes a style. */

import type { Editor } from "../editor.ts";
import { deskOf } from "../paths/path-desk.ts";
import type { ImportFormat } from "./format.ts";

/** Whether a dropped BVH is meant as a style: the path tool or the path's tab is open. */
let wanted: () => boolean = () => false;

export function styleImportFor(e: Editor): void {
  wanted = () => {
    const s = e.store.getState();
    return s.tab === "path" || s.tool === "path";
  };
}

export const styleImport: ImportFormat = {
  id: "style",
  label: "Style sample",
  endings: [".bvh"],
  accepts: () => wanted(),
  async open(e, files) {
    for (const file of files) await deskOf(e).add(file);
  },
};
