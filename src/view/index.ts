/** What `stepwright/view` exports: drawing with three.js, and driving a character of your own. */
export { type BoneMap, mapBones } from "./bone-map.ts";
export { buildCharacterMesh, type CharacterMesh } from "./character/build-mesh.ts";
export { Figure } from "./character/figure.ts";
export { CharacterController, type ControllerOptions, type SolvedMotion } from "./controller.ts";
export { type Footprint, FootprintLayer } from "./footprints.ts";
export { Stage } from "./stage.ts";
export { CATEGORY_COLOURS, CATEGORY_WORDS, ROOMS, type Theme } from "./tokens.ts";
