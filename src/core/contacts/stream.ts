/**
 * The oracle on a motion that is still being made: frames go in one at a time, labels come out as many frames later as half a
 * window has, ten as published [Oracle §8].
 *
 * With the paper's features the answers are those of the whole motion, frame for frame. The own features of a whole motion also look at
 * what comes later, to know floor and drift; live they know only what has been. Short plants and gaps are not dropped:
 * that would need to know how long they will be.
 */
import { examplesPerFrame, featuresOfFrame, lookBack } from "./features.ts";
import { LEG_ROW, type MotionTrack } from "./motion-track.ts";
import { createNearestSearch, findNearest } from "./nearest.ts";
import { type Oracle, voteFrame } from "./oracle.ts";

/** The answer for one frame. */
export interface LiveLabel {
  /** Index of the frame, counted from the first one given. */
  frame: number;
  /** Four contact bits. */
  labels: number;
  /** Share of votes for each bit. */
  share: [number, number, number, number];
  /** Distance to the nearest example. */
  distance: number;
}

export interface OracleStream {
  /** Frames at 60 Hz between a frame and its label. */
  latency: number;
  /**
   * The next frame at 60 Hz.
   *
   * @param points 2 x LEG_ROW numbers, @param root x, y, z, heading, as rows of a MotionTrack.
   * @returns the label of the frame `latency` before it, or null in the first frames.
   */
  push(points: ArrayLike<number>, root: ArrayLike<number>): LiveLabel | null;
  /** The labels still owed, once the motion has ended. */
  end(): LiveLabel[];
}

/** @param leg leg length of the figure, metres. */
export function createOracleStream(oracle: Oracle, leg: number): OracleStream {
  const { options, index } = oracle;
  const latency = options.half;
  const back = lookBack(options);
  const per = examplesPerFrame(options);
  const capacity = back + latency + 1;
  const row = 2 * LEG_ROW;
  const window: MotionTrack = {
    name: "live",
    frames: 0,
    leg,
    points: new Float64Array(row * capacity),
    root: new Float64Array(4 * capacity),
  };
  const searches = Array.from({ length: per }, () =>
    createNearestSearch(index, Math.min(options.k, index.count)),
  );
  const down = [false, false, false, false];
  const share = new Float32Array(4);
  let given = 0;
  let answered = 0;

  const answer = (): LiveLabel => {
    // Where the frame to be answered lies among those kept.
    const at = answered - (given - window.frames);
    const features = featuresOfFrame(window, at, options);
    share.fill(0);
    let distance = 0;
    searches.forEach((search, e) => {
      findNearest(search, features, e * index.size);
      voteFrame(oracle, search.found, search.size, share, 2 * e);
      distance = Math.max(distance, Math.sqrt(search.distance[0]));
    });
    let labels = 0;
    for (let b = 0; b < 4; b++) {
      const v = share[b];
      if (answered === 0) down[b] = v >= 0.5;
      if (down[b] ? v < options.off : v > options.on) down[b] = !down[b];
      if (down[b]) labels |= 1 << b;
    }
    return { frame: answered++, labels, share: [share[0], share[1], share[2], share[3]], distance };
  };

  return {
    latency,
    push(points, root) {
      if (window.frames === capacity) {
        window.points.copyWithin(0, row);
        window.root.copyWithin(0, 4);
        window.frames--;
      }
      for (let k = 0; k < row; k++) window.points[row * window.frames + k] = points[k];
      for (let k = 0; k < 4; k++) window.root[4 * window.frames + k] = root[k];
      window.frames++;
      given++;
      return given - answered > latency ? answer() : null;
    },
    end() {
      const out: LiveLabel[] = [];
      while (answered < given) out.push(answer());
      return out;
    },
  };
}
