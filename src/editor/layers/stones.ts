/** Stones, ground and landing-error columns in the stage. */
import { Group } from "three";
import { ErrorColumns, StoneField } from "../../view/stones.ts";
import type { Editor } from "../editor.ts";
import { idsOf, ref } from "../selection.ts";
import type { ViewportLayer } from "./layer.ts";

/** What the layer shows beside the scene: switched in the panel. */
export const stoneView = { columns: false };

export function stoneLayer(e: Editor): ViewportLayer {
  const field = new StoneField();
  const columns = new ErrorColumns();
  const object = new Group();
  object.add(field.group, columns.group);
  const draw = (): void => {
    const { scene, selection, plan } = e.store.getState();
    field.setTerrain(scene.terrain);
    field.setStones(scene.stones, scene.terrain, idsOf(selection, "stone"));
    e.stage.showFloor(!field.ownGround);
    const blend = plan?.blend;
    columns.set(
      stoneView.columns && blend
        ? blend.choices.flatMap((c, k) => {
            const s = plan.steps[blend.first + k];
            return s && Number.isFinite(c.before) ? [{ x: s.x, y: s.y, z: s.z, error: c.before }] : [];
          })
        : [],
    );
  };
  return {
    id: "stones",
    object,
    update: draw,
    theme(theme) {
      field.setTheme(theme);
      columns.setTheme(theme);
    },
    pick(ray) {
      const id = field.pick(ray);
      return id ? ref("stone", id) : null;
    },
    dispose() {
      field.dispose();
      columns.dispose();
    },
  };
}
