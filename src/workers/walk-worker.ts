/** Walks by wish off the page's thread: a velocity comes in, sixty poses a second go out. */
import { NOW } from "../core/blending/batch.ts";
import { type BlendCrowd, createBlendCrowd } from "../core/blending/crowd.ts";
import { createWalker, type Walker } from "../core/blending/walker.ts";
import { groundHeight, groundNormal } from "../core/scene/terrain.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../studio/blend-library.ts";
import type { WalkRequest, WalkResponse } from "./walk-protocol.ts";

const FRAME = 1 / 60;
/** Most that the wish changes in a second: m/s and rad/s. */
const QUICKEN = 2.4;

let timer: ReturnType<typeof setInterval> | null = null;
let crowd: BlendCrowd | null = null;
let walker: Walker | null = null;
const wish = [0, 0, 0];
const held = [0, 0, 0];

const post = (message: WalkResponse, transfer: Transferable[] = []): void => {
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(message, transfer);
};

function tick(): void {
  if (!crowd || !walker) return;
  for (let k = 0; k < 3; k++) {
    const most = QUICKEN * FRAME;
    held[k] += Math.max(-most, Math.min(most, wish[k] - held[k]));
  }
  walker.drive(held[0], held[1], held[2]);
  crowd.update(FRAME);
  const root = crowd.root.slice();
  const rotations = crowd.rotations.slice();
  const s = crowd.state;
  post({ type: "pose", root, rotations, place: [s[NOW], s[NOW + 1], s[NOW + 2]] }, [
    root.buffer,
    rotations.buffer,
  ]);
}

function start(m: Extract<WalkRequest, { type: "start" }>): void {
  const library = studioBlendLibrary(createSkeleton(m.height, m.proportions));
  crowd = createBlendCrowd(library, 1, { matrices: false });
  crowd.add({ ...m.place, y: groundHeight(m.terrain, m.place.x, m.place.z) });
  walker = createWalker(crowd, 0, (out, x, z) => {
    const [nx, nz] = groundNormal(m.terrain, x, z);
    out[0] = groundHeight(m.terrain, x, z);
    out[1] = nx;
    out[2] = nz;
  });
  wish.fill(0);
  held.fill(0);
  post({ type: "ready" });
  if (timer === null) timer = setInterval(tick, 1000 * FRAME);
}

self.onmessage = (event: MessageEvent<WalkRequest>) => {
  const m = event.data;
  try {
    switch (m.type) {
      case "start":
        start(m);
        break;
      case "wish":
        wish[0] = m.lateral;
        wish[1] = m.forward;
        wish[2] = m.turn;
        break;
      case "stop":
        if (timer !== null) clearInterval(timer);
        timer = null;
        break;
    }
  } catch (error) {
    post({ type: "failed", message: error instanceof Error ? error.message : String(error) });
  }
};
