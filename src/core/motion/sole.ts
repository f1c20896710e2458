/**
 * The planted foot in closed form: where the ankle is when the foot rests on the ground at a given pitch.
 *
 * A resting foot rolls over its heel (toe up), lies flat, then rolls over its ball and at last over the tip of the
 * toes (heel up). One number, the pitch, says it all, and the point that bears never moves: no inverse kinematics, no
 * skating. Both the studio and the motion stage use it.
 */
import { wrapAngle } from "../math/angle.ts";
import type { FootShape } from "../skeleton/skeleton.ts";

/** Heel-up pitch at which the toes begin to leave the ground with the foot, radians: measured toe bend before toe-off is 20-34 degrees. */
const TOE_BEND = (32 * Math.PI) / 180;
/** Softness of that, radians. */
const TOE_SOFT = (4 * Math.PI) / 180;
/** A heel this little raised still bears: 3.5 mm at the heel point. */
const HEEL_RESTS = (-1.2 * Math.PI) / 180;
/** A toe this little raised still bears. */
const TOE_RESTS = (0.35 * Math.PI) / 180;

/** Pitch of the toe segment when the foot's pitch is `pitch` (toe up positive), radians: 0 until the toes roll, the foot's own when on the heel. */
export function toeSegmentPitch(pitch: number): number {
  if (pitch >= 0) return pitch;
  const x = (-pitch - TOE_BEND) / TOE_SOFT;
  return -TOE_SOFT * (x > 30 ? x : Math.log1p(Math.exp(x)));
}

/**
 * The ankle joint of a planted foot, seen from its footstep.
 *
 * @param out [0] forward and [1] up from the footstep's place, metres; [2] bend of the toes joint, radians, toes up
 *   against the foot positive (about the foot's -X).
 * @param pitch foot pitch, toe up positive, radians, -1.5 to 0.8.
 */
export function plantedAnkle(out: Float64Array | number[], shape: FootShape, pitch: number): void {
  const s = Math.sin(pitch);
  const c = Math.cos(pitch);
  if (pitch >= 0) {
    out[0] = -shape.heelBack + shape.heelBack * c - shape.ankleHeight * s;
    out[1] = shape.heelBack * s + shape.ankleHeight * c;
    out[2] = 0;
    return;
  }
  const toe = toeSegmentPitch(pitch);
  const ts = Math.sin(toe);
  const tc = Math.cos(toe);
  // Tip stays; the ball joint is behind and above it by the toe segment.
  const tip = shape.ballForward + shape.tipForward;
  const ballForward = tip - shape.tipForward * tc - shape.ballHeight * ts;
  const ballUp = -shape.tipForward * ts + shape.ballHeight * tc;
  const rise = shape.ankleHeight - shape.ballHeight;
  out[0] = ballForward - shape.ballForward * c - rise * s;
  out[1] = ballUp - shape.ballForward * s + rise * c;
  out[2] = toe - pitch;
}

/** Which ends of a planted foot bear at this pitch. */
export function heelRests(pitch: number): boolean {
  return pitch >= HEEL_RESTS;
}
export function toeRests(pitch: number): boolean {
  return pitch <= TOE_RESTS;
}

/** Contact bits of a planted foot: 1 heel, 2 toe. */
export function contactsOfPitch(pitch: number): number {
  return (heelRests(pitch) ? 1 : 0) | (toeRests(pitch) ? 2 : 0);
}

/**
 * Where a foot's footstep is after it has pivoted about its heel point or its ball.
 *
 * @param from the footstep before; @param yaw the yaw after.
 */
export function pivotPlace(
  shape: FootShape,
  from: { x: number; z: number; yaw: number },
  yaw: number,
  end: "heel" | "ball",
): { x: number; z: number; yaw: number } {
  const d = end === "heel" ? -shape.heelBack : shape.ballForward;
  return {
    x: from.x + d * (Math.sin(from.yaw) - Math.sin(yaw)),
    z: from.z + d * (Math.cos(from.yaw) - Math.cos(yaw)),
    yaw: wrapAngle(yaw),
  };
}
