/** Every feature of the editor, a line each. */
import { basics } from "./basics.ts";
import { captures } from "./captures.ts";
import type { Feature } from "./feature.ts";
import { paths } from "./paths.ts";
import { tasks } from "./tasks.ts";

export const ALL_FEATURES: readonly Feature[] = [basics, tasks, paths, captures];
