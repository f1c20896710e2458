/** The motion as files of other programs: BVH, glTF with the character, VRM animation. */
import { writeBvh } from "../../core/capture/bvh-write.ts";
import type { Clip } from "../../core/capture/clip.ts";
import { contactsCsv } from "../../core/contacts/csv.ts";
import { type ExportOptions, exportClip, footstepsCsv } from "../../core/motion/export-clip.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import type { Editor } from "../editor.ts";
import type { ExportFormat } from "./format.ts";

/** What the Export menu's switches say; kept while the page is open. */
export const exportOptions: ExportOptions = { rate: 60, inPlace: false };

/** A sentence while the whole motion has not arrived; null when it has. */
export function motionMissing(e: Editor): string | null {
  const m = e.plan.motion.current;
  const s = e.store.getState();
  return m && m.filled >= m.frames && s.plan && s.quality ? null : "The motion is not finished yet.";
}

/** The motion that is shown, whole. @throws Error when there is none. */
export function motionClip(e: Editor): Clip {
  const m = e.plan.motion.current;
  if (!m) throw new Error("there is no motion.");
  const { scene, name } = e.store.getState();
  const { height, proportions } = scene.character;
  return {
    name,
    skeleton: createSkeleton(height, proportions),
    rate: 60,
    frames: m.frames,
    root: Float64Array.from(m.root),
    rotations: Float64Array.from(m.rotations),
  };
}

const chosen = (e: Editor): Clip => exportClip(motionClip(e), exportOptions);

const motionFormat = (format: Omit<ExportFormat, "blocked">): ExportFormat => ({
  ...format,
  blocked: motionMissing,
});

export const motionExports: readonly ExportFormat[] = [
  motionFormat({
    id: "bvh",
    label: "Motion (BVH)",
    file: ".bvh",
    type: "text/plain",
    order: 0,
    make: (e) => writeBvh(chosen(e), { rootOffset: false }),
  }),
  motionFormat({
    id: "glb",
    label: "Character with motion (GLB)",
    file: ".glb",
    type: "model/gltf-binary",
    order: 1,
    async make(e) {
      const { mesh } = e.character;
      if (!mesh) throw new Error("the character is not drawn yet.");
      const { exportGlb } = await import("../../view/export-gltf.ts");
      const clip = chosen(e);
      return new Blob([await exportGlb(clip.skeleton, mesh, clip)]);
    },
  }),
  motionFormat({
    id: "vrma",
    label: "VRM animation (VRMA)",
    file: ".vrma",
    type: "model/gltf-binary",
    order: 2,
    async make(e) {
      const { exportVrma } = await import("../../view/export-gltf.ts");
      const clip = chosen(e);
      return new Blob([await exportVrma(clip.skeleton, clip)]);
    },
  }),
  motionFormat({
    id: "footsteps",
    label: "Footsteps (CSV)",
    file: "-footsteps.csv",
    type: "text/csv",
    order: 100,
    make(e) {
      const { plan } = e.store.getState();
      if (!plan) throw new Error("there is no plan.");
      return footstepsCsv(plan);
    },
  }),
  motionFormat({
    id: "contacts",
    label: "Contacts (CSV)",
    file: "-contacts.csv",
    type: "text/csv",
    order: 101,
    make(e) {
      const m = e.plan.motion.current;
      if (!m) throw new Error("there is no motion.");
      const frames = Math.floor(((m.frames - 1) * exportOptions.rate) / 60 + 1e-9) + 1;
      return contactsCsv(m.contacts, 60, exportOptions.rate, frames);
    },
  }),
];
