/** Landing points and velocities of the cyclic clips that ship: what the lesson on triangles draws. */
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../studio/blend-library.ts";

export interface LandingPoints {
  names: string[];
  /** Lateral and forward by turns, metres, left foot then right. */
  feet: [Float64Array, Float64Array];
  /** Lateral, forward (m/s) and turn (rad/s) of each clip. */
  velocities: { x: number; z: number; yaw: number }[];
}

/** Made anew; deterministic. */
export function landingPoints(): LandingPoints {
  const library = studioBlendLibrary(createSkeleton());
  return {
    names: library.names,
    feet: [library.feet[0].points, library.feet[1].points],
    velocities: library.analyses.map((a) => a.velocity),
  };
}

let asked: Promise<LandingPoints> | null = null;

/** The same from a worker, once; from the page where none can start. */
export function askLandingPoints(): Promise<LandingPoints> {
  asked ??= new Promise((resolve, reject) => {
    const here = (): void => {
      try {
        resolve(landingPoints());
      } catch (error) {
        reject(error);
      }
    };
    let worker: Worker;
    try {
      worker = new Worker(new URL("./landing-worker.ts", import.meta.url), { type: "module" });
    } catch {
      // A frame without an origin, or a file on a disk.
      here();
      return;
    }
    worker.onmessage = (e: MessageEvent<LandingPoints>) => {
      worker.terminate();
      resolve(e.data);
    };
    worker.onerror = (e) => {
      e.preventDefault();
      worker.terminate();
      here();
    };
    worker.postMessage(null);
  });
  return asked;
}
