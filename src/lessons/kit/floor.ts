/**
 * A plan of the floor seen from above, forward (+Z) upwards and the character's left (+X) to the left: footprints, points that
 * can be dragged, lines. Metres in, SVG elements out.
 */

import type { Foot } from "../../core/steps/types.ts";
import { setAttributes, svgEl } from "../../embed/dom.ts";
import type { Parameters } from "./parameters.ts";

/** A right sole about its ankle, metres, forward upwards: forefoot and heel apart; the left is its mirror image. */
const FOREFOOT =
  "M-.034-.045C-.04-.09-.05-.11-.05-.142C-.05-.192-.012-.214.006-.21C.04-.2.046-.15.043-.115C.041-.09.034-.07.033-.045Z";
const HEEL = "M-.033-.026L.033-.026C.037.03.025.062 0 .064C-.025.062-.037.03-.033-.026Z";

export interface FloorPrint {
  foot: Foot;
  x: number;
  z: number;
  yaw: number;
}

export interface FloorView {
  /** Middle of the picture and its width, metres. */
  x: number;
  z: number;
  width: number;
  /** Height over width. */
  aspect: number;
}

export class Floor {
  readonly svg: SVGSVGElement;
  /** Layers from back to front. */
  readonly back = svgEl("g");
  readonly prints = svgEl("g");
  readonly front = svgEl("g");
  readonly handles = svgEl("g");
  private readonly scale: number;
  private readonly widthPx: number;
  private readonly heightPx: number;

  /** @param widthPx width of the drawing's own units; the picture scales with its box. */
  constructor(
    readonly view: FloorView,
    label: string,
    widthPx = 440,
    private readonly unit = "m",
  ) {
    this.widthPx = widthPx;
    this.heightPx = Math.round(widthPx * view.aspect);
    this.scale = widthPx / view.width;
    this.svg = svgEl("svg", {
      viewBox: `0 0 ${this.widthPx} ${this.heightPx}`,
      class: "floor",
      role: "group",
      "aria-label": label,
    });
    this.svg.append(this.grid(), this.back, this.prints, this.front, this.handles);
  }

  px(x: number): number {
    return Math.round(10 * (this.widthPx / 2 - (x - this.view.x) * this.scale)) / 10;
  }
  py(z: number): number {
    return Math.round(10 * (this.heightPx / 2 - (z - this.view.z) * this.scale)) / 10;
  }
  /** Metres to the drawing's units. */
  length(metres: number): number {
    return metres * this.scale;
  }

  private grid(): SVGGElement {
    const g = svgEl("g", { class: "grid" });
    const { view } = this;
    const half = view.width / 2;
    const tall = half * view.aspect;
    const every = view.width > 7 ? 1 : 0.5;
    for (let k = Math.ceil((view.x - half) / every); k * every <= view.x + half; k++)
      g.append(svgEl("line", { x1: this.px(k * every), x2: this.px(k * every), y1: 0, y2: this.heightPx }));
    for (let k = Math.ceil((view.z - tall) / every); k * every <= view.z + tall; k++)
      g.append(svgEl("line", { y1: this.py(k * every), y2: this.py(k * every), x1: 0, x2: this.widthPx }));
    const y = this.heightPx - 12;
    const x = this.widthPx - 14;
    const metre = this.length(every);
    const word = svgEl(
      "text",
      { x: x - metre / 2, y: y - 6, "text-anchor": "middle" },
      `${every} ${this.unit}`,
    );
    g.append(
      svgEl("path", { class: "rule", d: `M${x - metre} ${y - 3}v6M${x - metre} ${y}H${x}M${x} ${y - 3}v6` }),
      word,
    );
    return g;
  }

  /** A footprint; `fill` null for an outline. */
  print(p: FloorPrint, options: { fill?: string | null; class?: string; title?: string } = {}): SVGGElement {
    const side = p.foot === "left" ? -1 : 1;
    const turn = (-p.yaw * 180) / Math.PI;
    const g = svgEl("g", {
      class: `print ${options.class ?? ""} ${options.fill ? "" : "outline"}`,
      transform: `translate(${this.px(p.x)} ${this.py(p.z)}) rotate(${turn.toFixed(1)}) scale(${(side * this.scale).toFixed(2)} ${this.scale.toFixed(2)})`,
    });
    for (const d of [FOREFOOT, HEEL])
      g.append(svgEl("path", { d, fill: options.fill ?? "none", "vector-effect": "non-scaling-stroke" }));
    if (options.title) g.append(svgEl("title", {}, options.title));
    return g;
  }

  /** A line through points, metres. */
  line(
    points: readonly (readonly [number, number])[],
    attributes: Record<string, string | number>,
  ): SVGPathElement {
    const d = points.map(([x, z], i) => `${i === 0 ? "M" : "L"}${this.px(x)} ${this.py(z)}`).join("");
    return svgEl("path", { d, fill: "none", ...attributes });
  }

  /** Where a pointer is, metres. */
  at(e: PointerEvent): [number, number] {
    const box = this.svg.getBoundingClientRect();
    const x = ((e.clientX - box.left) / box.width) * this.widthPx;
    const y = ((e.clientY - box.top) / box.height) * this.heightPx;
    return [
      this.view.x - (x - this.widthPx / 2) / this.scale,
      this.view.z - (y - this.heightPx / 2) / this.scale,
    ];
  }

  /**
   * A point that can be dragged, or moved with the arrow keys: parameters `name.x` and `name.z`.
   *
   * @returns its group, to draw more into.
   */
  handle(
    parameters: Parameters,
    name: string,
    start: readonly [number, number],
    label: string,
    radius = 9,
  ): SVGGElement {
    const { view } = this;
    const half = view.width / 2 - 0.05;
    const tall = half * view.aspect;
    parameters.declare({
      name: `${name}.x`,
      value: start[0],
      min: view.x - half,
      max: view.x + half,
      step: 0.01,
    });
    parameters.declare({
      name: `${name}.z`,
      value: start[1],
      min: view.z - tall,
      max: view.z + tall,
      step: 0.01,
    });
    const locked = parameters.locked(name);
    const g = svgEl("g", {
      class: `handle ${locked ? "locked" : ""}`,
      role: "button",
      tabindex: locked ? -1 : 0,
      "aria-disabled": locked ? "true" : null,
    });
    g.append(
      svgEl("circle", { r: Math.max(22, radius), class: "catch" }),
      svgEl("circle", { r: radius, class: "dot" }),
    );
    const place = (): void => {
      const [x, z] = [parameters.get(`${name}.x`), parameters.get(`${name}.z`)];
      setAttributes(g, {
        transform: `translate(${this.px(x)} ${this.py(z)})`,
        "aria-label": `${label}, ${(-x).toFixed(2)} metres to the right, ${z.toFixed(2)} metres ahead. Arrow keys move it.`,
      });
    };
    const move = (x: number, z: number): void => {
      parameters.set(`${name}.x`, x);
      parameters.set(`${name}.z`, z);
    };
    parameters.watch([name], place);
    if (!locked) {
      g.addEventListener("pointerdown", (e) => {
        if (e.button !== 0) return;
        e.preventDefault();
        g.focus({ preventScroll: true });
        g.setPointerCapture(e.pointerId);
        const from = this.at(e);
        const [x0, z0] = [parameters.get(`${name}.x`), parameters.get(`${name}.z`)];
        const drag = (m: PointerEvent): void => {
          const to = this.at(m);
          move(x0 + to[0] - from[0], z0 + to[1] - from[1]);
        };
        const end = (): void => {
          g.removeEventListener("pointermove", drag);
          g.removeEventListener("pointerup", end);
          g.removeEventListener("pointercancel", end);
        };
        g.addEventListener("pointermove", drag);
        g.addEventListener("pointerup", end);
        g.addEventListener("pointercancel", end);
      });
      g.addEventListener("keydown", (e) => {
        const step = e.altKey ? 0.01 : e.shiftKey ? 0.25 : 0.05;
        const way = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
        if (!way) return;
        e.preventDefault();
        move(parameters.get(`${name}.x`) + way[0] * step, parameters.get(`${name}.z`) + way[1] * step);
      });
    }
    place();
    this.handles.append(g);
    return g;
  }
}
