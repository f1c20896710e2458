/** Characters from files: glTF and VRM, their bones mapped by name, the motion on them with the feet planted. */
import { characterTab } from "../panels/character.ts";
import type { Feature } from "./feature.ts";

export const characters: Feature = {
  id: "characters",
  tabs: [characterTab],
  imports: [
    {
      id: "character",
      label: "Character (glTF, VRM)",
      endings: [".glb", ".vrm", ".gltf"],
      open: (e, files) => e.guest.open(files[files.length - 1]),
    },
  ],
  layers: [
    (e) => ({
      id: "guest",
      update(_, what) {
        if (what === "scene") e.guest.follow();
      },
    }),
  ],
};
