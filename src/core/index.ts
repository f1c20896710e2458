/**
 * The core of Stepwright, as the package `stepwright` exports it: scenes, planning, motion, captures, contacts, styles, blending and
 * crowds. No DOM, no three.js, no worker; metres, seconds, radians, Y up.
 */
export {
  createFootSpace,
  createLocated,
  type FootSpace,
  type Located,
  locate,
} from "./blending/foot-space.ts";
export { type Choice, chooseMix, createChoice, createMix, type Mix } from "./blending/mix.ts";
export { createRootSpace, type RootSpace, rootWeights } from "./blending/polar-bands.ts";
export { BvhError, type BvhFile, parseBvh, readBvhStream } from "./capture/bvh-parse.ts";
export { writeBvh } from "./capture/bvh-write.ts";
export type { Clip } from "./capture/clip.ts";
export { CLIP_RATE } from "./capture/clip.ts";
export { type ImportReport, type ImportResult, importBvh, importBvhFile } from "./capture/import.ts";
export { mapJoints } from "./capture/names.ts";
export type { Sidecar, SidecarTask } from "./capture/sidecar.ts";
export { type CleanReport, cleanBvh } from "./cleanup/clean-bvh.ts";
export { type BaselineOptions, detectContacts } from "./contacts/baselines.ts";
export { type MotionTrack, trackOf } from "./contacts/motion-track.ts";
export {
  askOracle,
  type LabelledTrack,
  type Oracle,
  type OracleAnswer,
  type OracleOptions,
  OWN_ORACLE,
  PAPER_ORACLE,
  trainOracle,
} from "./contacts/oracle.ts";
export { crowdOfScene } from "./crowd/from-scene.ts";
export { simulateCrowd } from "./crowd/simulate.ts";
export type { CrowdWorld } from "./crowd/types.ts";
export {
  beginSynthesis,
  handResults,
  type Synthesis,
  synthesiseChunk,
  synthesiseClip,
} from "./motion/synthesise.ts";
export type { BoxTrack, InkStroke, MotionChunk, QualityFigures } from "./motion/types.ts";
export { evaluateFootsteps, type FootstepProblem } from "./optimize/footstep-objective.ts";
export { createFootstepWorkspace, optimizeFootsteps } from "./optimize/optimize-footsteps.ts";
export { type ObjectiveWeights, PHASE_WEIGHTS, TERM_NAMES } from "./optimize/phase-weights.ts";
export { measureMotion } from "./quality/measure.ts";
export {
  addPath,
  addTask,
  changeTask,
  placeTask,
  removePath,
  removeTask,
  reshapePath,
  setCharacter,
} from "./scene/commands.ts";
export { defaultScene } from "./scene/default-scene.ts";
export { History } from "./scene/history.ts";
export { type ResultDocument, type ResultFootstep, resultDocument } from "./scene/result.ts";
export { parseResult, ResultError, readResult } from "./scene/result-schema.ts";
export { parseScene, readScene, SceneError, serializeScene } from "./scene/schema.ts";
export type { Effort, TaskCategory } from "./scene/task-types.ts";
export type {
  CrowdSpec,
  Scene,
  ScenePath,
  SceneProp,
  SceneStone,
  SceneTask,
  Terrain,
} from "./scene/types.ts";
export { forwardKinematics } from "./skeleton/forward-kinematics.ts";
export { JOINT_COUNT, JOINT_NAMES, type JointName, PARENTS } from "./skeleton/joints.ts";
export { createSkeleton, DEFAULT_PROPORTIONS, type Proportions, type Skeleton } from "./skeleton/skeleton.ts";
export { type Solved, solveScene } from "./solve-scene.ts";
export type { ContactTrack, Foot, Footstep, Phase, Step, StepCategory } from "./steps/types.ts";
export { STEP_CATEGORIES } from "./steps/types.ts";
export { goalsOf, planScene } from "./tasks/plan-scene.ts";
export type { Plan, PlannedStep, PlannedTask } from "./tasks/plan-types.ts";
export { buildLibrary } from "./templates/build-library.ts";
export { decodeLibrary, encodeLibrary } from "./templates/library-file.ts";
export { retargetLibrary } from "./templates/retarget-library.ts";
export type { Library, Template } from "./templates/types.ts";
