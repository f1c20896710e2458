/** Paths: drawn on the floor, painted with styles [Express]. */
import { pathThings } from "../things/paths.ts";
import { pathTool } from "../tools/path.ts";
import type { Feature } from "./feature.ts";

export const paths: Feature = {
  id: "paths",
  tools: [pathTool],
  things: [pathThings],
};
