/** Paths on the floor in the colours of their styles, and the styles' names on paper plates beside them. */
import { html, render } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import type { MotionPath } from "../../core/styles/path.ts";
import { nearestOnPath, placeOnPath, readPath } from "../../core/styles/path.ts";
import { swatchSvg } from "../../plots/style-pattern.ts";
import { type BandSpan, bandSpans, curveOf, PathBands } from "../../view/path-bands.ts";
import type { Editor } from "../editor.ts";
import { deskOf, stretchesOf } from "../paths/path-desk.ts";
import { ref } from "../selection.ts";
import type { ViewportLayer } from "./layer.ts";
import { PLATE_HEIGHT, placePlates } from "./plate-places.ts";

/** How near to a path a pointer counts as on it, metres. */
export const ON_PATH = 0.13;

interface Drawn {
  id: string;
  curve: MotionPath;
  spans: BandSpan[];
}

const drawn = new WeakMap<Editor, { bands: PathBands; paths: Drawn[] }>();

/** The path nearest to a place on the floor within `reach` metres, and the share of it there. */
export function pathNear(
  e: Editor,
  at: readonly [number, number],
  reach = ON_PATH,
): { id: string; at: number; curve: MotionPath; metres: number } | null {
  let best: { id: string; at: number; curve: MotionPath; metres: number } | null = null;
  let least = reach;
  for (const p of drawn.get(e)?.paths ?? []) {
    const near = nearestOnPath(p.curve, at[0], at[1]);
    if (near.distance > least) continue;
    least = near.distance;
    best = { id: p.id, at: near.at / p.curve.length, curve: p.curve, metres: near.at };
  }
  return best;
}

/** Shows where a point or change would be; null takes the mark away. */
export function markFloor(e: Editor, at: readonly [number, number] | null): void {
  drawn.get(e)?.bands.point(at, e.store.getState().theme === "dark" ? "#f2f1ed" : "#16191d");
  e.stage.invalidate();
}

/** Width of a plate without its word, and of a letter, about; pixels. */
const AROUND_WORD = 51;
const LETTER = 6.6;

export function pathBandLayer(e: Editor): ViewportLayer {
  const bands = new PathBands();
  const state = { bands, paths: [] as Drawn[] };
  drawn.set(e, state);
  const plates = document.createElement("div");
  plates.className = "plates";
  e.markers.overlay.before(plates);
  const p = new Float64Array(2);

  const label = (): void => {
    const desk = deskOf(e);
    const named = state.paths.flatMap(({ id, curve, spans }) =>
      spans.flatMap((s, k) => {
        if (s.to - s.from < 0.5) return [];
        const middle = (s.from + s.to) / 2;
        placeOnPath(p, curve, middle);
        const t = readPath(curve, curve.heading, middle);
        const at = e.stage.project(p[0], 0.01, p[1]);
        if (!at.visible) return [];
        // The plate stands on the side of the path that is farther from the camera.
        const aside = e.stage.project(p[0] + 0.3 * Math.cos(t), 0.01, p[1] - 0.3 * Math.sin(t));
        const side = Math.sign((aside.y < at.y ? 1 : -1) * (aside.x - at.x) || 1);
        const word = `${s.style[0].toUpperCase()}${s.style.slice(1)}`;
        const chosen = desk.chosen?.path === id && desk.chosen.index === k;
        return [
          { x: at.x, y: at.y, side, width: AROUND_WORD + LETTER * word.length, word, chosen, style: s.style },
        ];
      }),
    );
    const handles = e.store
      .getState()
      .scene.paths.flatMap((path) => path.points)
      .map(([x, z]): [number, number] => {
        const at = e.stage.project(x, 0.05, z);
        return [at.x, at.y];
      });
    const offsets = placePlates(named, handles, e.stage.freeRoom);
    render(
      named.map(({ x, y, word, chosen, style }, i) => {
        const [dx, dy] = offsets[i];
        // The line ends at the plate's edge.
        const [lx, ly] = [dx, dy - (Math.sign(dy) * PLATE_HEIGHT) / 2];
        return html`<div class="plate ${chosen ? "chosen" : ""}" style="transform:translate(${x.toFixed(1)}px,${y.toFixed(1)}px)"><i style="width:${Math.hypot(lx, ly).toFixed(1)}px;rotate:${Math.atan2(ly, lx).toFixed(3)}rad"></i><span style="translate:calc(${dx.toFixed(1)}px - 50%) ${(dy - PLATE_HEIGHT / 2).toFixed(1)}px">${unsafeSVG(swatchSvg(desk.look(style), 28, 14))}${word}</span></div>`;
      }),
      plates,
    );
  };
  bands.onDraw = label;

  const draw = (): void => {
    const desk = deskOf(e);
    state.paths = e.store.getState().scene.paths.flatMap((path): Drawn[] => {
      const curve = curveOf(path);
      return curve
        ? [{ id: path.id, curve, spans: bandSpans({ ...path, styles: stretchesOf(path) }, curve.length) }]
        : [];
    });
    bands.set(state.paths, (style) => desk.look(style));
    label();
  };

  return {
    id: "path-bands",
    object: bands.group,
    update(_, what) {
      if (what === "scene" || what === "look") draw();
      else label();
    },
    pick(ray) {
      const { origin, direction } = ray.ray;
      if (direction.y >= -1e-6) return null;
      const k = -origin.y / direction.y;
      const near = pathNear(e, [origin.x + k * direction.x, origin.z + k * direction.z]);
      return near ? ref("path", near.id) : null;
    },
    dispose() {
      bands.dispose();
      plates.remove();
    },
  };
}
