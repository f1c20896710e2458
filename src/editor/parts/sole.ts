/** A small sole with its category's colour and mark: what lies on the floor, in legends and lists. */
import { html, type SVGTemplateResult, svg, type TemplateResult } from "lit";
import type { Foot, StepCategory } from "../../core/steps/types.ts";
import { FOREFOOT, HEEL } from "../../view/sole-outline.ts";
import { CATEGORY_COLOURS } from "../../view/tokens.ts";

/** The second cue of each category, drawn on the forefoot about (0, -128). */
const MARKS: Record<StepCategory, SVGTemplateResult | null> = {
  HeelPivot: svg`<circle cx="0" cy="14" r="15" /><path d="M-22-120C-10-142 12-142 22-124" />`,
  ToePivot: svg`<circle cx="0" cy="-140" r="15" /><path d="M-20 8C-10 26 10 26 20 8" />`,
  SideStep: svg`<path d="M-26-128H26M8-148L28-128L8-108" />`,
  TurnAndStep: svg`<path d="M-18-98V-128H22M6-148L26-128L6-108" />`,
  Walk: null,
  ForwardStepDuringTask: svg`<path d="M-24-112L0-142L24-112" />`,
  BackwardStepDuringTask: svg`<path d="M-24-142L0-112L24-142" />`,
};

/** @param fill overrides the category's colour. */
export function sole(category: StepCategory, foot: Foot = "right", fill?: string): TemplateResult {
  const c = CATEGORY_COLOURS[category];
  return html`<svg class="sole" viewBox="-56 -216 112 284" aria-hidden="true" style="--fill: ${fill ?? c.fill}; --mark: ${c.mark}"><g transform=${foot === "left" ? "scale(-1 1)" : "scale(1 1)"}><path d=${FOREFOOT} /><path d=${HEEL} />${MARKS[category] ? svg`<g class="cue">${MARKS[category]}</g>` : ""}</g></svg>`;
}
