/** Places on the ground, seen from others. */
export interface Place {
  x: number;
  z: number;
  yaw: number;
}

/** The place that lies `lateral` to the left of another and `forward` ahead of it, turned by `yaw`. */
export function placeAt(from: Place, lateral: number, forward: number, yaw: number): Place {
  const c = Math.cos(from.yaw);
  const s = Math.sin(from.yaw);
  return {
    x: from.x + c * lateral + s * forward,
    z: from.z - s * lateral + c * forward,
    yaw: from.yaw + yaw,
  };
}
