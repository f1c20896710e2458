/**
 * Crowds in motion: a session's footsteps walked by the stepping-stone controller [Barycentric], which meets them in place and
 * time [Footsteps §4.1].
 */
import { type BlendCrowd, createBlendCrowd } from "../blending/crowd.ts";
import type { BlendLibrary } from "../blending/library.ts";
import { arcTangent } from "./elementary.ts";
import type { CrowdFootstep } from "./footfalls.ts";
import { type CrowdSession, changeSession, createSession, runSession } from "./session.ts";
import type { CrowdWorld } from "./types.ts";

/** Longest step of the animation's clock, seconds. */
const FRAME = 1 / 30;
/** Twists that are over are swept away when there are so many. */
const MOST_OVER = 64;

export interface CrowdMotion {
  session: CrowdSession;
  body: BlendCrowd;
  /** Footsteps of each agent that the controller has not been given yet, in order. */
  waiting: CrowdFootstep[][];
  /** Footsteps of the session handed on so far. */
  handed: number;
}

export function createCrowdMotion(world: CrowdWorld, library: BlendLibrary): CrowdMotion {
  const body = createBlendCrowd(library, Math.max(1, world.agents.length));
  for (const a of world.agents) body.add({ x: a.x, z: a.z, yaw: arcTangent(a.dirX, a.dirZ) });
  return { session: createSession(world), body, waiting: world.agents.map(() => []), handed: 0 };
}

/** Hands footsteps on, as far as the controller has room for them. */
function feed(m: CrowdMotion): void {
  const { footsteps } = m.session;
  for (; m.handed < footsteps.length; m.handed++) {
    const { step } = footsteps[m.handed];
    // Feet that stood there from the start are where they are.
    if (step.lift !== null) m.waiting[step.agent].push(step);
  }
  m.waiting.forEach((list, i) => {
    let given = 0;
    for (const s of list) {
      const pushed = m.body.push(i, {
        foot: s.side > 0 ? "left" : "right",
        x: s.x,
        y: 0,
        z: s.z,
        yaw: s.yaw,
        lift: s.lift ?? 0,
        land: s.land,
      });
      if (!pushed) break;
      given++;
    }
    if (given > 0) list.splice(0, given);
  });
}

/** Turns torsos over their feet as planned, with an ease that begins and ends without a jerk. */
function twist(m: CrowdMotion, now: number): void {
  const { upperYaw } = m.body;
  upperYaw.fill(0);
  const { twists } = m.session;
  let over = 0;
  for (const t of twists) {
    const u = (now - t.start) / t.duration;
    if (u > 1) {
      over++;
      continue;
    }
    if (u < 0 || m.session.gone[t.agent] < now) continue;
    upperYaw[t.agent] = t.from + (t.to - t.from) * u * u * u * (10 - 15 * u + 6 * u * u);
  }
  if (over > MOST_OVER) m.session.twists = twists.filter((t) => now <= t.start + t.duration);
}

/**
 * Moves everybody on to `seconds` on the crowd's clock.
 *
 * @param most ticks simulated at once. @returns whether that moment was reached; else call again.
 */
export function moveCrowd(m: CrowdMotion, seconds: number, most = 40): boolean {
  if (!runSession(m.session, seconds, most)) return false;
  feed(m);
  while (m.body.time < seconds - 1e-9) {
    const step = Math.min(FRAME, seconds - m.body.time);
    twist(m, m.body.time + step);
    m.body.update(step);
    feed(m);
  }
  return true;
}

/** Changes the world as it is shown now; false when its agents are others. */
export function changeCrowd(m: CrowdMotion, world: CrowdWorld): boolean {
  const now = m.body.time;
  if (!changeSession(m.session, world, now)) return false;
  // What has not begun is forgotten and given anew from what still holds.
  m.waiting.forEach((list, i) => {
    list.length = 0;
    m.body.clear(i);
  });
  for (const { step } of m.session.footsteps)
    if (step.lift !== null && step.lift > now) m.waiting[step.agent].push(step);
  m.handed = m.session.footsteps.length;
  return true;
}
