/** A right sole as SVG paths, millimetres about the point under the ankle, toes up; as `footprints.ts` draws it on the floor. */
export const FOREFOOT =
  "M-34-45C-40-90-50-110-50-142C-50-192-12-214 6-210C40-200 46-150 43-115C41-90 34-70 33-45Z";
export const HEEL = "M-33-22H33C37 30 25 60 0 62C-25 60-37 30-33-22Z";
