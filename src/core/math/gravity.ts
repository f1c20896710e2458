/** Standard gravity as every model here has it, metres a second squared. */
export const GRAVITY = 9.81;
