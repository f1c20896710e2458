/** Straight walks, runs and steps of one gait at one pace: from standing, so many steps, to standing. */
import type { GroundPose } from "../../core/math/frame2.ts";
import type { Foot } from "../../core/steps/types.ts";
import { type Actor, paceOf, type Score } from "../score.ts";
import { createWalker, finish, other, sideOf, step } from "./walker.ts";

export interface StraightOptions {
  name: string;
  seed: number;
  actor: Actor;
  /** Steps between the first and the closing one, at least 1. */
  steps: number;
  first?: Foot;
  /** Shares of the step length by which a runner comes up to speed, and in reverse slows down. */
  runUp?: readonly number[];
  start?: GroundPose;
}

/** A quick run-up; a fast runner's hips tip far forward in it. */
const RUN_UP = [0.72, 0.9];

/**
 * A straight performance: first step, `steps` steady ones, a shorter one, and the feet together.
 *
 * The pace's step length and time are those of the steady part, at the reference leg of 0.93 m.
 */
export function straightScore(options: StraightOptions): Score {
  const { name, seed, actor, runUp = RUN_UP } = options;
  const w = createWalker(name, seed, options.start ?? { x: 0, z: 0, yaw: 0 }, actor);
  const pace = paceOf(actor);
  const kind = pace.stance < 0.5 ? "run" : "walk";
  let foot: Foot = options.first ?? "left";
  const start = options.start ?? { x: 0, z: 0, yaw: 0 };
  let way = 0;
  const lay = (length: number, slow: number): void => {
    way += length * w.scale;
    const side = sideOf(foot) * (pace.width / 2) * w.scale + 0.006 * pace.noise * w.random.normal();
    const out = sideOf(foot) * pace.toeOut + 0.012 * pace.noise * w.random.normal();
    step(
      w,
      foot,
      kind,
      {
        x: start.x + Math.sin(start.yaw) * way + Math.cos(start.yaw) * side,
        z: start.z + Math.cos(start.yaw) * way - Math.sin(start.yaw) * side,
        yaw: start.yaw + out,
      },
      slow,
    );
    foot = other(foot);
  };
  const vary = () => 1 + 0.012 * pace.noise * w.random.normal();
  lay(pace.length * (kind === "run" ? 0.5 : 0.78), 1.1);
  // A runner takes some steps to come up to speed, and to slow down.
  if (kind === "run") for (const share of runUp) lay(pace.length * share, 1);
  for (let k = 0; k < options.steps; k++) lay(pace.length * vary(), 1);
  if (kind === "run") for (const share of [...runUp].reverse()) lay(pace.length * share, 1);
  lay(pace.length * (kind === "run" ? 0.5 : 0.82), 1.05);
  // Beside the other foot.
  step(
    w,
    foot,
    "close",
    {
      x: start.x + Math.sin(start.yaw) * way + Math.cos(start.yaw) * sideOf(foot) * 0.095 * w.scale,
      z: start.z + Math.cos(start.yaw) * way - Math.sin(start.yaw) * sideOf(foot) * 0.095 * w.scale,
      yaw: start.yaw + sideOf(foot) * 0.12,
    },
    1.1,
  );
  return finish(w);
}
