/** The result document as a file: footsteps, contacts, timing, figures. */
import { resultDocument } from "../../core/scene/result.ts";
import type { ExportFormat } from "./format.ts";
import { motionMissing } from "./motion-ready.ts";

export const resultExport: ExportFormat = {
  id: "result",
  label: "Footsteps, contacts, figures (JSON)",
  file: "result.json",
  type: "application/json",
  order: 100,
  blocked: motionMissing,
  make(e) {
    const s = e.store.getState();
    const m = e.plan.motion.current;
    if (!s.plan || !s.quality || !m) throw new Error("there is no motion.");
    return `${JSON.stringify(resultDocument(s.scene, s.plan, m.contacts, s.quality))}\n`;
  },
};
