/** A scene beside what its planner did for the task that is being come to: the templates that competed, the objective while it fell. */
import { el } from "../../embed/dom.ts";
import { drawPanels, taskAt } from "../../embed/panels.ts";
import { fillValues, type MountFigure } from "../kit/figure.ts";
import { fixed } from "../kit/numbers.ts";

export const mount: MountFigure = ({ figure, box }) => {
  const scene = figure.querySelector("stepwright-scene");
  if (!scene) throw new Error("plan-scene: the figure holds no scene.");
  const side = el("div", { class: "pane padded side" });
  const panes = figure.querySelector(".panes");
  panes?.append(side);
  box.remove();
  figure.append(box);
  const names = (figure.dataset.panels ?? "templates objective").split(" ");
  let shown = -1;
  const draw = (): void => {
    if (!scene.plan) return;
    shown = taskAt(scene.plan, scene.currentTime);
    drawPanels(side, names, scene.plan, scene.quality, scene.currentTime);
    const trace = scene.plan.traces.find((t) => t.task === shown && t.terms.length > 1);
    const last = trace?.terms[trace.terms.length - 1];
    if (last)
      fillValues({
        "plan.f": fixed(last[0], 3),
        "plan.steps": String(scene.plan.steps.length),
        "plan.iterations": String((trace?.terms.length ?? 1) - 1),
      });
  };
  scene.addEventListener("planned", draw);
  scene.addEventListener("solved", draw);
  scene.addEventListener("timeupdate", () => {
    if (scene.plan && taskAt(scene.plan, scene.currentTime) !== shown) draw();
  });
  draw();
};
