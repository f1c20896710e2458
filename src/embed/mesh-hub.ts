/** The characters' skins, one of each build for all elements of a page: from a worker, or from the page where none can start. */
import { createSkeleton, type Proportions } from "../core/skeleton/skeleton.ts";
import type { CharacterMesh } from "../view/character/build-mesh.ts";
import type { MeshRequest, MeshResponse } from "../workers/mesh-worker.ts";
import { absolute, places } from "./resources.ts";

/** Builds that are kept. */
const MOST = 6;

interface Waiting {
  request: MeshRequest;
  resolve(mesh: CharacterMesh): void;
  reject(error: unknown): void;
}

const meshes = new Map<string, Promise<CharacterMesh>>();
const waiting = new Map<number, Waiting>();
let worker: Worker | null = null;
let nextId = 1;

/**
 * The skin of a build; built once.
 *
 * @param fineness size of its cells: 1 for one that is looked at, `COARSE` for one that is there sooner.
 * @throws Error when it cannot be built.
 */
export function characterMesh(
  height: number,
  proportions: Proportions,
  fineness: number,
): Promise<CharacterMesh> {
  const key = `${height}/${proportions.leg}/${proportions.arm}/${proportions.torso}/${fineness}`;
  let mesh = meshes.get(key);
  if (!mesh) {
    mesh = build(height, proportions, fineness);
    meshes.set(key, mesh);
    for (const old of meshes.keys()) {
      if (meshes.size <= MOST) break;
      meshes.delete(old);
    }
    // A build that failed may be tried again.
    mesh.catch(() => meshes.delete(key));
  }
  return mesh;
}

function build(height: number, proportions: Proportions, fineness: number): Promise<CharacterMesh> {
  return new Promise((resolve, reject) => {
    const request = { id: nextId++, height, proportions, fineness };
    waiting.set(request.id, { request, resolve, reject });
    try {
      worker ??= startWorker();
      worker.postMessage(request);
    } catch {
      // Another origin's script, or a frame without an origin.
      buildHere();
    }
  });
}

function startWorker(): Worker {
  const w = createWorker();
  w.onmessage = (event: MessageEvent<MeshResponse>) => {
    waiting.get(event.data.id)?.resolve(event.data.mesh);
    waiting.delete(event.data.id);
    // Nothing is left to do: the worker's memory is given back. After a coarse skin its fine one is asked for.
    if (waiting.size === 0 && event.data.fineness <= 1) stopWorker();
  };
  w.onerror = (event) => {
    event.preventDefault();
    stopWorker();
    buildHere();
  };
  return w;
}

function stopWorker(): void {
  worker?.terminate();
  worker = null;
}

/** Everything that waits, on the page's own thread. */
function buildHere(): void {
  const all = [...waiting.values()];
  waiting.clear();
  import("../view/character/build-mesh.ts").then(
    ({ buildCharacterMesh }) => {
      for (const w of all) {
        try {
          const { height, proportions, fineness } = w.request;
          w.resolve(buildCharacterMesh(createSkeleton(height, proportions), fineness));
        } catch (error) {
          w.reject(error);
        }
      }
    },
    (error: unknown) => {
      for (const w of all) w.reject(error);
    },
  );
}

function createWorker(): Worker {
  const { workers } = places();
  if (workers !== null)
    return new Worker(new URL("mesh-worker.js", absolute(`${workers.replace(/\/?$/, "/")}`)), {
      type: "module",
    });
  return new Worker(new URL("../workers/mesh-worker.ts", import.meta.url), { type: "module" });
}
