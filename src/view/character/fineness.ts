/** Cells of the skin that is shown first, in those of the one that is looked at: an eighth of the work. */
export const COARSE = 2.2;
