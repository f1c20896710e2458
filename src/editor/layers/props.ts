/** Which piece of furniture is under the pointer; the stage draws it. */
import type { Editor } from "../editor.ts";
import { ref } from "../selection.ts";
import type { ViewportLayer } from "./layer.ts";

export function propLayer(e: Editor): ViewportLayer {
  return {
    id: "furniture",
    pick(ray) {
      const id = e.stage.propOn(ray);
      return id === null ? null : ref("prop", id);
    },
  };
}
