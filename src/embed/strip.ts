/** The bar's strip: a row a foot, a block a plant in the colour of the step that led to it, and a line at the present time. */
import type { Plan } from "../core/tasks/plan-types.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../view/tokens.ts";
import { setAttributes, svgEl } from "./dom.ts";

const ROW = 12;
const GAP = 3;
const HEIGHT = 2 * ROW + GAP + 8;
/** Free at both ends, so that the line is whole. */
const MARGIN = 3;

/** A foot's rest: seconds from landing to the next lift, and the step that led to it; -1 for the stance at the start. */
export interface Plant {
  foot: "left" | "right";
  from: number;
  to: number;
  step: number;
}

/** Plants of a plan, in order of landing, the two start stances first. */
export function plantsOf(plan: Plan): Plant[] {
  const out: Plant[] = [];
  const open: Record<"left" | "right", Plant> = {
    left: { foot: "left", from: 0, to: plan.duration, step: -1 },
    right: { foot: "right", from: 0, to: plan.duration, step: -1 },
  };
  out.push(open.left, open.right);
  plan.steps.forEach((s, step) => {
    open[s.foot].to = Math.min(plan.duration, Math.max(open[s.foot].from, s.lift));
    open[s.foot] = { foot: s.foot, from: Math.min(plan.duration, s.land), to: plan.duration, step };
    out.push(open[s.foot]);
  });
  return out;
}

/** A slider over the motion's time. Its `oninput` callback gets seconds. */
export class Strip {
  readonly element: HTMLElement;
  private readonly svg = svgEl("svg", { "aria-hidden": "true", preserveAspectRatio: "none" });
  private readonly blocks = svgEl("g");
  private readonly halo = svgEl("line", { class: "halo", y1: 0, y2: HEIGHT });
  private readonly now = svgEl("line", { class: "now", y1: 0, y2: HEIGHT });
  private plan: Plan | null = null;
  private width = 0;
  private time = 0;

  constructor(
    make: HTMLElement,
    private readonly seek: (seconds: number) => void,
  ) {
    this.element = make;
    setAttributes(make, {
      class: "strip",
      role: "slider",
      tabindex: 0,
      "aria-label": "Time",
      "aria-valuemin": 0,
      "aria-valuemax": 0,
      "aria-valuenow": 0,
    });
    this.svg.append(this.blocks, this.halo, this.now);
    make.append(this.svg);
    make.addEventListener("pointerdown", (e) => this.down(e));
    make.addEventListener("keydown", (e) => this.key(e));
  }

  resize(width: number): void {
    if (width === this.width) return;
    this.width = width;
    setAttributes(this.svg, { width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}` });
    this.draw();
  }

  setPlan(plan: Plan): void {
    this.plan = plan;
    setAttributes(this.element, { "aria-valuemax": plan.duration.toFixed(2) });
    this.draw();
  }

  setTime(time: number): void {
    this.time = time;
    const x = this.x(time);
    for (const line of [this.halo, this.now]) setAttributes(line, { x1: x, x2: x });
    setAttributes(this.element, {
      "aria-valuenow": time.toFixed(2),
      "aria-valuetext": `${time.toFixed(2)} of ${(this.plan?.duration ?? 0).toFixed(2)} seconds`,
    });
  }

  private x(time: number): number {
    const duration = Math.max(0.01, this.plan?.duration ?? 0);
    return Math.round(10 * (MARGIN + (time / duration) * Math.max(0, this.width - 2 * MARGIN))) / 10;
  }

  private draw(): void {
    this.blocks.replaceChildren();
    if (!this.plan || this.width < 10) return;
    for (const p of plantsOf(this.plan)) {
      const step = p.step < 0 ? null : this.plan.steps[p.step];
      const x = this.x(p.from);
      const width = Math.max(1.5, this.x(p.to) - x - 1);
      const rect = svgEl("rect", {
        x,
        width,
        y: 4 + (p.foot === "left" ? 0 : ROW + GAP),
        height: ROW,
        rx: Math.min(3, width / 2),
        class: step ? null : "start",
        fill: step ? CATEGORY_COLOURS[step.category].fill : null,
      });
      const word = step ? CATEGORY_WORDS[step.category].toLowerCase() : "start";
      rect.append(
        svgEl(
          "title",
          {},
          `${p.foot === "left" ? "Left" : "Right"}, ${word}, ${p.from.toFixed(2)} to ${p.to.toFixed(2)} s`,
        ),
      );
      this.blocks.append(rect);
    }
    this.setTime(this.time);
  }

  private down(e: PointerEvent): void {
    if (e.button !== 0 || !this.plan) return;
    const left = this.element.getBoundingClientRect().left + MARGIN;
    const duration = this.plan.duration;
    const to = (x: number) =>
      this.seek(Math.max(0, Math.min(1, (x - left) / Math.max(1, this.width - 2 * MARGIN))) * duration);
    to(e.clientX);
    this.element.setPointerCapture(e.pointerId);
    const move = (m: PointerEvent) => to(m.clientX);
    const end = () => {
      this.element.removeEventListener("pointermove", move);
      this.element.removeEventListener("pointerup", end);
      this.element.removeEventListener("pointercancel", end);
    };
    this.element.addEventListener("pointermove", move);
    this.element.addEventListener("pointerup", end);
    this.element.addEventListener("pointercancel", end);
  }

  private key(e: KeyboardEvent): void {
    const step = e.shiftKey ? 1 : 1 / 60;
    const to: Record<string, number> = {
      ArrowLeft: this.time - step,
      ArrowDown: this.time - step,
      ArrowRight: this.time + step,
      ArrowUp: this.time + step,
      PageDown: this.time - 1,
      PageUp: this.time + 1,
      Home: 0,
      End: this.plan?.duration ?? 0,
    };
    if (!(e.key in to)) return;
    e.preventDefault();
    this.seek(to[e.key]);
  }
}
