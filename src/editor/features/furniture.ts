/** Furniture: selected, moved and sized on its own. */
import { propLayer } from "../layers/props.ts";
import { propTab } from "../panels/prop.ts";
import { propThings } from "../things/props.ts";
import type { Feature } from "./feature.ts";

export const furniture: Feature = {
  id: "furniture",
  things: [propThings],
  tabs: [propTab],
  layers: [propLayer],
};
