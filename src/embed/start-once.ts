/**
 * Starts a page once. Pages without an origin (sandboxed frames, files opened from a disk) may not be able to load modules; a classic
 * script brings the same code there, and where both arrive the first one counts.
 */
declare global {
  var stepwrightStarted: Set<string> | undefined;
}

export function startOnce(name: string, start: () => void): void {
  globalThis.stepwrightStarted ??= new Set();
  if (globalThis.stepwrightStarted.has(name)) return;
  globalThis.stepwrightStarted.add(name);
  start();
}
