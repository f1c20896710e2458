/** Left for right: clips, contacts, footsteps and tasks, reflected in the plane x = 0. */
import { JOINT_COUNT, MIRROR_JOINT } from "../skeleton/joints.ts";
import type { ContactTrack, Footstep } from "../steps/types.ts";
import type { Clip } from "./clip.ts";
import type { SidecarTask } from "./sidecar.ts";

/** The mirrored clip; mirroring twice gives the clip back exactly. */
export function mirrorClip(clip: Clip): Clip {
  const { frames } = clip;
  const root = Float64Array.from(clip.root);
  const rotations = new Float64Array(clip.rotations.length);
  for (let f = 0; f < frames; f++) {
    root[3 * f] = -root[3 * f];
    for (let j = 0; j < JOINT_COUNT; j++) {
      const a = 4 * (f * JOINT_COUNT + j);
      const b = 4 * (f * JOINT_COUNT + MIRROR_JOINT[j]);
      rotations[b] = clip.rotations[a];
      rotations[b + 1] = -clip.rotations[a + 1];
      rotations[b + 2] = -clip.rotations[a + 2];
      rotations[b + 3] = clip.rotations[a + 3];
    }
  }
  return { ...clip, name: `${clip.name}~`, root, rotations };
}

export function mirrorContacts(contacts: ContactTrack): ContactTrack {
  return contacts.map((c) => ((c & 3) << 2) | (c >> 2));
}

export function mirrorFootstep(s: Footstep): Footstep {
  return { foot: s.foot === "left" ? "right" : "left", x: -s.x, y: s.y, z: s.z, yaw: -s.yaw };
}

export function mirrorTask(t: SidecarTask): SidecarTask {
  return {
    ...t,
    position: [-t.position[0], t.position[1], t.position[2]],
    yaw: -t.yaw,
    hand: t.hand === "both" ? "both" : t.hand === "left" ? "right" : "left",
  };
}
