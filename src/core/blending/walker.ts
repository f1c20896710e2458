/**
 * Root control: a velocity in, footsteps out [Barycentric §5, lambda_4 = 1].
 *
 * The polar bands weigh the clips for the wanted velocity; their blended landing point is where the next foot goes, in the
 * frame that the root's track has at the lift. One step is known ahead, and made anew while the wish changes.
 */
import { lerpAngle, wrapAngle } from "../math/angle.ts";
import { type GroundPose, midPose } from "../math/frame2.ts";
import { uniformMove } from "./analyse.ts";
import { AIR, F_LAND, FOOT, FOOT_STATE, LAST_SIDE, STATE } from "./batch.ts";
import type { BlendCrowd } from "./crowd.ts";
import { MOVE_ROW } from "./library.ts";
import { rootWeights } from "./polar-bands.ts";
import { DURATION, SWING } from "./step-query.ts";
import type { GroundMove } from "./types.ts";

/** Slower than this is standing, m/s and rad/s. */
const STILL = 0.06;
/** Seconds from a wish to the first lift. */
const START = 0.3;
/** Feet this far from standing side by side are brought together, metres and radians. */
const NEAR = 0.05;
const NEAR_TURN = 0.1;
/** Times of the step that brings them together. */
const CLOSE_WAIT = 0.16;
const CLOSE_SWING = 0.42;

/** Height and normal of the ground, into out: y, normal x, normal z. */
export type GroundAt = (out: Float64Array, x: number, z: number) => void;

export interface Walker {
  /** Call before each `crowd.update`. Lateral and forward m/s, turn rad/s, in the character's own frame. */
  drive(lateral: number, forward: number, turn: number): void;
}

/**
 * Steers character i of a crowd.
 *
 * @param ground the ground that footsteps are laid on; left out: flat at 0.
 */
export function createWalker(crowd: BlendCrowd, i: number, ground: GroundAt | null = null): Walker {
  const { library } = crowd;
  const weights = new Float64Array(library.names.length);
  const level = new Float64Array(3);
  const feet = [
    { x: 0, y: 0, z: 0, yaw: 0 },
    { x: 0, y: 0, z: 0, yaw: 0 },
  ];
  const move: GroundMove = { x: 0, z: 0, yaw: 0 };
  const blended = (side: number, column: number): number => {
    let out = 0;
    for (let c = 0; c < weights.length; c++)
      if (weights[c] > 0) out += weights[c] * library.moves[MOVE_ROW * (2 * c + side) + column];
    return out;
  };
  const push = (side: number, at: GroundPose, lift: number, land: number): void => {
    level.fill(0);
    ground?.(level, at.x, at.z);
    crowd.push(i, {
      foot: side === 0 ? "left" : "right",
      x: at.x,
      y: level[0],
      z: at.z,
      yaw: wrapAngle(at.yaw),
      lift,
      land,
      normal: [level[1], level[2]],
    });
  };

  /** The last step of a walk: the foot behind comes beside the other. */
  const close = (side: number, last: number): void => {
    const { standFoot } = library;
    const other = feet[1 - side];
    const sign = side === 0 ? 1 : -1;
    const yaw = other.yaw + sign * standFoot.yaw;
    const width = 2 * standFoot.x;
    const at = {
      x: other.x + sign * Math.cos(yaw) * width,
      z: other.z - sign * Math.sin(yaw) * width,
      yaw: yaw + sign * standFoot.yaw,
    };
    const own = feet[side];
    const off = Math.hypot(own.x - at.x, own.z - at.z);
    if (off < NEAR && Math.abs(wrapAngle(own.yaw - at.yaw)) < NEAR_TURN) return;
    const lift = Math.max(crowd.time, last + CLOSE_WAIT);
    push(side, at, lift, lift + CLOSE_SWING);
  };

  /** First lift from standing, once there is a wish. */
  let begin = Number.POSITIVE_INFINITY;

  return {
    drive(lateral, forward, turn) {
      const s = crowd.state;
      const o = STATE * i;
      crowd.clear(i);
      const flying = [crowd.footstep(i, 0, feet[0]), crowd.footstep(i, 1, feet[1])];
      const lands = [0, 1].map((side) => s[o + FOOT + FOOT_STATE * side + F_LAND]);
      const last = Math.max(lands[0], lands[1]);
      const standing = !flying[0] && !flying[1] && crowd.time - last > 0.5;
      const still = Math.hypot(lateral, forward) < STILL && Math.abs(turn) < STILL;
      // The foot that is not the last to land steps next; from standing, the one on the way's side.
      const side = standing
        ? lateral + 0.3 * turn > 0.02
          ? 0
          : lateral + 0.3 * turn < -0.02
            ? 1
            : 1 - s[o + LAST_SIDE]
        : lands[0] > lands[1]
          ? 1
          : 0;
      if (still) {
        begin = Number.POSITIVE_INFINITY;
        crowd.steer(i, 0, 0, 0, 0);
        close(side, last);
        return;
      }
      crowd.steer(i, 1, lateral, forward, turn);
      rootWeights(weights, library.root, lateral, forward, turn);
      const swing = blended(side, SWING);
      const duration = blended(side, DURATION);
      const wait = duration - swing;
      // The foot that steps may still be down after its own last landing, or not yet lifted in a run.
      const rest = lands[side] + 0.12;
      if (!standing) begin = Number.POSITIVE_INFINITY;
      else if (begin === Number.POSITIVE_INFINITY) begin = crowd.time + START;
      const lift = standing
        ? Math.max(begin, crowd.time)
        : Math.max(last + wait, rest, s[o + FOOT + FOOT_STATE * side + AIR] === 1 ? rest : crowd.time);
      const land = lift + swing;
      // The root by the track at the last landing, then on by the wanted velocity.
      const at = {
        x: (feet[0].x + feet[1].x) / 2,
        z: (feet[0].z + feet[1].z) / 2,
        yaw: lerpAngle(feet[0].yaw, feet[1].yaw, 0.5),
      };
      if (!standing) {
        uniformMove(move, { x: lateral, z: forward, yaw: turn }, wait);
        forwardBy(at, move.x, move.z);
        at.yaw += move.yaw;
      }
      const yaw = at.yaw + blended(side, 2);
      forwardBy(at, blended(side, 0), blended(side, 1));
      push(side, { x: at.x, z: at.z, yaw }, lift, land);
      // A second step lets the heel behind rise: where it goes is decided anew before it begins.
      const other = 1 - side;
      const next = lift + blended(other, DURATION);
      // The body goes over the feet that are known: this one must not seem to stay where it is.
      const then = midPose({ x: at.x, z: at.z, yaw }, feet[other]);
      uniformMove(move, { x: lateral, z: forward, yaw: turn }, Math.max(0, next - land));
      forwardBy(then, move.x, move.z);
      then.yaw += move.yaw;
      const thenYaw = then.yaw + blended(other, 2);
      forwardBy(then, blended(other, 0), blended(other, 1));
      push(other, { x: then.x, z: then.z, yaw: thenYaw }, next, next + blended(other, SWING));
    },
  };
}

/** Moves a place by lateral and forward metres in its own frame. */
function forwardBy(at: GroundPose, lateral: number, forward: number): void {
  const c = Math.cos(at.yaw);
  const n = Math.sin(at.yaw);
  at.x += c * lateral + n * forward;
  at.z += c * forward - n * lateral;
}
