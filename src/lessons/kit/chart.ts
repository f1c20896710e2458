/** Curves over an axis, as the lessons draw them: a few horizontal hairlines, names at the axes' ends, no frame. Pure data in, elements out. */

import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { setAttributes, svgEl } from "../../embed/dom.ts";
import { fixed } from "./numbers.ts";

export interface ChartOptions {
  width: number;
  height: number;
  x: [number, number];
  y: [number, number];
  xName: string;
  yName: string;
  label: string;
  /** Free at the right, for names of curves. */
  right?: number;
}

/** Least and most of a box in which a chart's letters keep their size, CSS pixels. */
const [LEAST, NARROW] = [320, 620];

/** How wide a chart is drawn: as wide as wished, or as its box on a narrow page, where it would be too small to read. */
export const chartWidth = (box: HTMLElement, wished: number): number =>
  box.clientWidth > 0 && box.clientWidth < NARROW ? Math.max(LEAST, box.clientWidth - 26) : wished;

export class Chart {
  readonly svg: SVGSVGElement;
  readonly content = svgEl("g");
  readonly x: ReturnType<typeof scaleLinear<number, number>>;
  readonly y: ReturnType<typeof scaleLinear<number, number>>;
  private readonly axes = svgEl("g");

  constructor(private readonly o: ChartOptions) {
    this.x = scaleLinear<number, number>(o.x, [40, o.width - (o.right ?? 12)]);
    this.y = scaleLinear<number, number>(o.y, [o.height - 30, 24]);
    this.svg = svgEl("svg", {
      viewBox: `0 0 ${o.width} ${o.height}`,
      class: "chart",
      role: "img",
      "aria-label": o.label,
    });
    this.svg.append(this.axes, this.content);
    this.drawAxes();
  }

  /** Other bounds; the axes follow. */
  setBounds(x: [number, number], y: [number, number]): void {
    this.x.domain(x);
    this.y.domain(y);
    this.drawAxes();
  }

  /** The finding in one sentence, for those who do not see the curves. */
  setFinding(text: string): void {
    setAttributes(this.svg, { "aria-label": text });
  }

  private drawAxes(): void {
    const { o } = this;
    const left = this.x.range()[0];
    const right = this.x.range()[1];
    const bottom = this.y.range()[0];
    const places = (ticks: number[]): number =>
      ticks.some((t) => Math.abs(t * 10 - Math.round(t * 10)) > 1e-6)
        ? 2
        : ticks.some((t) => !Number.isInteger(t))
          ? 1
          : 0;
    const ys = this.y.ticks(4);
    const xs = this.x.ticks(5);
    const [py, px] = [places(ys), places(xs)];
    this.axes.replaceChildren(
      ...ys.flatMap((t) => [
        svgEl("line", { class: "axis", x1: left, x2: right, y1: this.y(t), y2: this.y(t) }),
        svgEl("text", { x: left - 6, y: this.y(t) + 4, "text-anchor": "end" }, fixed(t, py)),
      ]),
      ...xs.map((t) =>
        svgEl("text", { x: this.x(t), y: bottom + 15, "text-anchor": "middle" }, fixed(t, px)),
      ),
      svgEl("text", { x: left, y: 12, class: "name" }, o.yName),
      svgEl("text", { x: right, y: o.height - 2, "text-anchor": "end", class: "name" }, o.xName),
    );
  }

  curve(
    values: readonly (readonly [number, number])[],
    attributes: Record<string, string | number>,
  ): SVGPathElement {
    const path = line<readonly [number, number]>(
      (d) => Math.round(10 * this.x(d[0])) / 10,
      (d) => Math.round(10 * this.y(d[1])) / 10,
    );
    return svgEl("path", { d: path(values as [number, number][]) ?? "", fill: "none", ...attributes });
  }
}
