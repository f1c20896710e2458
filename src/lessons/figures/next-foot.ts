/** The checkpoints' questions: taken from the plan of a scene on the page. */

import type { StepCategory } from "../../core/steps/types.ts";
import type { Plan, PlannedStep } from "../../core/tasks/plan-types.ts";
import { type NextFoot, nextFootCheckpoint } from "../kit/checkpoint.ts";
import type { MountFigure } from "../kit/figure.ts";
import type { FloorPrint } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";
import { walkOf } from "./pendulum-walk.ts";

const BECAUSE: Partial<Record<StepCategory, string>> = {
  TurnAndStep:
    "It is a turn and step: the foot lands turned towards where the walk goes next, so the next one can go straight.",
  Walk: "It is a walking step: as far ahead of the other foot as that one was of this, because the spacing term makes successive lengths equal.",
  SideStep: "It is a side step: the body keeps facing the task while the feet travel across.",
  ToePivot: "It is a toe pivot: the ball stays where it was and the heel swings, so the ankle hardly moves.",
  HeelPivot: "It is a heel pivot: the heel stays where it was and the toes swing, so the ankle hardly moves.",
  ForwardStepDuringTask:
    "It is a step at the task: short, and placed where the template's stance in front of the task wants it.",
  BackwardStepDuringTask:
    "It is a step back at the task: the template brings the feet under the body before the hands let go.",
};

function because(s: PlannedStep): string {
  const goal = s.phase === "enter" ? " In the enter phase the goal's term weighs half of everything." : "";
  return `${BECAUSE[s.category] ?? ""}${goal}`;
}

function fromPlan(plan: Plan): NextFoot[] {
  const prints: FloorPrint[] = [...plan.start, ...plan.steps];
  const wanted: ((s: PlannedStep, i: number) => boolean)[] = [
    (s, i) => i > 2 && s.category === "TurnAndStep",
    (s, i) => i > 4 && s.category === "Walk" && s.phase === "locomotion",
    (s, i) => i > 6 && s.phase === "enter",
  ];
  const taken = new Set<number>();
  return wanted.flatMap((want) => {
    const i = plan.steps.findIndex((s, k) => !taken.has(k) && want(s, k));
    if (i < 0) return [];
    taken.add(i);
    return [{ steps: prints.slice(Math.max(0, i - 4), i + 3), because: because(plan.steps[i]) }];
  });
}

/** Questions from the first scene of the page, once it is planned; they stay when the scene is dragged. */
export const mountTask: MountFigure = ({ box }) => {
  const scene = document.querySelector("stepwright-scene");
  let asked = false;
  const begin = (): void => {
    if (asked || !scene?.plan) return;
    asked = true;
    nextFootCheckpoint(box, fromPlan(scene.plan));
  };
  scene?.addEventListener("planned", begin);
  begin();
};

/** Questions from walks of the pendulum: nearly straight, bent, slow. */
export const mountPendulum: MountFigure = ({ box }) => {
  const actions = [
    {
      turn: 0.1,
      speed: 1.3,
      why: "The path is nearly straight: the foot lands beside the apex of its parabola, half a step width out.",
    },
    {
      turn: 0.6,
      speed: 1.0,
      why: "The parabola bends strongly, so its apex lies farther out, and the foot that it bends about farther still.",
    },
    {
      turn: 0.25,
      speed: 0.7,
      why: "A slower walker covers less ground in the same time: the step is shorter and as wide.",
    },
  ];
  nextFootCheckpoint(
    box,
    actions.map(({ turn, speed, why }): NextFoot => {
      const steps = walkOf({ turn, speed, duration: 0.5, count: 5 });
      return {
        steps: steps.map((s) => s.print),
        because: `${why} Each step here takes 0.50 s at ${fixed(speed, 1)} m/s.`,
      };
    }),
  );
};
