/** What the viewport shows, as a picture. */
import type { ExportFormat } from "./format.ts";

export const pictureExport: ExportFormat = {
  id: "picture",
  label: "Picture of the room (PNG)",
  file: "room.png",
  type: "image/png",
  order: 300,
  make: (e) => e.stage.picture(),
};
