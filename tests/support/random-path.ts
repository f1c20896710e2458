/** Random paths with random styles, a seed each. */
import { createRandom } from "../../src/core/math/random.ts";
import { STYLES } from "../../src/studio/styles.ts";

export interface RandomPath {
  points: number[][];
  styles: { at: number; style: string }[];
  smooth: boolean;
}

/** Four to nine corners, 0.6 to 1.6 m apart, that turn by up to a radian each; three styles; three in ten with sharp corners. */
export function randomPath(seed: number): RandomPath {
  const random = createRandom(seed);
  let heading = random.between(-3, 3);
  const at = [0, 0];
  const points = Array.from({ length: 4 + Math.floor(6 * random.next()) }, () => {
    heading += random.between(-1, 1);
    at[0] += Math.sin(heading) * random.between(0.6, 1.6);
    at[1] += Math.cos(heading) * random.between(0.6, 1.6);
    return [...at];
  });
  const styles = [0, 1, 2].map((i) => ({
    at: i / 3,
    style: STYLES[Math.floor(random.next() * STYLES.length)],
  }));
  return { points, styles, smooth: random.next() < 0.7 };
}
