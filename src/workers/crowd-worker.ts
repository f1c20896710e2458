/** Simulates and animates crowds off the page's thread, and streams what is shown. */
import { type CrowdMotion, changeCrowd, createCrowdMotion, moveCrowd } from "../core/crowd/motion.ts";
import { tellPlan } from "../core/crowd/plan-story.ts";
import { boundAt } from "../core/crowd/sight.ts";
import { hashCrowd } from "../core/crowd/track-hash.ts";
import { TICK } from "../core/crowd/types.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../studio/blend-library.ts";
import { buildCharacterMesh } from "../view/character/build-mesh.ts";
import type { CrowdFrame, CrowdRequest, CrowdResponse } from "./crowd-protocol.ts";

/** Mesh cells of near and far bodies over those of the one character: 20 and 40 mm beside 9. */
const FINENESS = [20 / 9, 40 / 9];
const ROWS = 12 * JOINT_COUNT;

const skeleton = createSkeleton(1.75);
/** Made when a crowd is first wanted: about a second of work. */
let library: ReturnType<typeof studioBlendLibrary> | null = null;
let motion: CrowdMotion | null = null;

const post = (message: CrowdResponse, transfer: Transferable[] = []): void =>
  (self as unknown as { postMessage(m: CrowdResponse, t: Transferable[]): void }).postMessage(
    message,
    transfer,
  );

function begin(id: number, world: CrowdMotion["session"]["crowd"]["world"]): void {
  library ??= studioBlendLibrary(skeleton);
  motion = createCrowdMotion(world, library);
  post({ type: "ready", id, agents: world.agents.length, repairs: world.repairs });
}

const createFrame = (count: number): CrowdFrame => ({
  seconds: 0,
  count,
  matrices: new Float32Array(count * ROWS),
  places: new Float32Array(count * 5),
  here: new Uint8Array(count),
});

/** Writes everybody's matrices as rows: what a bone texture takes. */
function fill(frame: CrowdFrame, m: CrowdMotion): void {
  const { matrices, root, time } = m.body;
  const { crowd, gone } = m.session;
  frame.seconds = time;
  const tick = Math.floor(time / TICK);
  for (let i = 0; i < frame.count; i++) {
    frame.here[i] = gone[i] > time ? 1 : 0;
    frame.places[5 * i] = root[3 * i];
    frame.places[5 * i + 1] = root[3 * i + 1];
    frame.places[5 * i + 2] = root[3 * i + 2];
    const o = boundAt(crowd.sight, i, Math.max(tick, crowd.sight.since[i]));
    frame.places[5 * i + 3] = crowd.sight.bound[o + 2];
    frame.places[5 * i + 4] = crowd.sight.bound[o + 3];
    for (let j = 0; j < JOINT_COUNT; j++) {
      const from = (i * JOINT_COUNT + j) * 16;
      const to = i * ROWS + 12 * j;
      for (let row = 0; row < 3; row++)
        for (let column = 0; column < 4; column++)
          frame.matrices[to + 4 * row + column] = matrices[from + 4 * column + row];
    }
  }
}

function show(request: Extract<CrowdRequest, { type: "show" }>): void {
  if (!motion) return;
  const { crowd, footsteps, gone } = motion.session;
  const ticks = crowd.tick;
  const begun = performance.now();
  const reached = moveCrowd(motion, request.seconds, 4);
  const simulatedMs = performance.now() - begun;
  const count = crowd.people.length;
  const frame = request.frame?.count === count ? request.frame : createFrame(count);
  fill(frame, motion);
  const { picked } = request;
  const now = motion.body.time;
  const { plans, expanded, generated } = crowd.statistics;
  post(
    {
      type: "frame",
      id: request.id,
      frame,
      reached,
      left: gone.reduce((n, t) => n + (t > now ? 1 : 0), 0),
      story: picked >= 0 ? tellPlan(crowd, picked) : null,
      footsteps:
        picked >= 0 ? footsteps.map((f) => f.step).filter((s) => s.agent === picked && s.land > now - 4) : [],
      figures: { plans, expanded, generated, simulatedMs, ticks: crowd.tick - ticks },
    },
    [frame.matrices.buffer, frame.places.buffer, frame.here.buffer],
  );
}

function answer(request: CrowdRequest): void {
  switch (request.type) {
    case "start":
      begin(request.id, request.world);
      break;
    case "change": {
      const same = motion !== null && changeCrowd(motion, request.world);
      post({ type: "changed", id: request.id, again: !same });
      if (!same) begin(request.id, request.world);
      break;
    }
    case "show":
      show(request);
      break;
    case "meshes": {
      const meshes = FINENESS.map((f) => buildCharacterMesh(skeleton, f));
      post(
        { type: "meshes", meshes },
        meshes.flatMap((m) => [
          m.positions.buffer,
          m.normals.buffer,
          m.indices.buffer,
          m.skinIndices.buffer,
          m.skinWeights.buffer,
        ]),
      );
      break;
    }
    case "simulate":
      post({ type: "simulated", id: request.id, ...hashCrowd(request.world, request.seconds) });
      break;
  }
}

self.onmessage = (event: MessageEvent<CrowdRequest>) => {
  try {
    answer(event.data);
  } catch (error) {
    const id = "id" in event.data ? event.data.id : 0;
    post({ type: "failed", id, message: error instanceof Error ? error.message : String(error) });
  }
};
