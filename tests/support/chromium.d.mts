/** Path of a Chromium that is there, or undefined for Playwright's own. */
export function chromiumPath(): string | undefined;
export function chromiumFlags(): string[];
/** Makes sure that there is one; false after saying what to install. */
export function ensureChromium(): boolean;
