/**
 * Where an element's captures and workers are, and how they are read where nothing may be fetched.
 *
 * By default they lie beside this module. A page that keeps them elsewhere says so once, before its first element.
 */

export interface Resources {
  /** Address of the captures, `library.bin`; `library.js` beside it holds the same for pages that may not fetch. */
  library: string;
  /** Folder with `planner-worker.js` and `mesh-worker.js` on the page's own origin; null leaves them beside this module. */
  workers: string | null;
  /** Address of the editor that "Open" leads to; null hides the button. */
  editor: string | null;
}

const resources: Resources = { library: "", workers: null, editor: null };

/** Sets where things are. Addresses are taken from the document's. */
export function configure(change: Partial<Resources>): void {
  Object.assign(resources, change);
}

export function absolute(address: string): string {
  return new URL(address, document.baseURI).href;
}

/** The present places, the library's made absolute. */
export function places(): Resources {
  const library =
    resources.library === ""
      ? new URL(/* @vite-ignore */ "library.bin", import.meta.url).href
      : absolute(resources.library);
  return { ...resources, library };
}

declare global {
  /** What `library.js` leaves behind: the captures' bytes in base 64. */
  var stepwrightLibrary: string | undefined;
}

function addScript(address: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = address;
    script.onload = () => {
      script.remove();
      resolve();
    };
    script.onerror = () => {
      script.remove();
      reject(new Error(`${address}: the captures could not be loaded.`));
    };
    document.head.append(script);
  });
}

function fromBase64(text: string): Uint8Array {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/**
 * The captures' bytes on the page's own thread. A sandboxed frame without an origin, and a page opened from a disk, may
 * not fetch: there the script beside the file brings them.
 *
 * @throws Error that names the address.
 */
export async function libraryBytes(address: string): Promise<Uint8Array> {
  try {
    const answer = await fetch(address);
    if (answer.ok) return new Uint8Array(await answer.arrayBuffer());
  } catch (error) {
    // A refused fetch is a TypeError; anything else is a fault of ours.
    if (!(error instanceof TypeError)) throw error;
  }
  if (globalThis.stepwrightLibrary === undefined) await addScript(address.replace(/\.bin(?=$|[?#])/, ".js"));
  if (globalThis.stepwrightLibrary === undefined)
    throw new Error(`${address}: the captures could not be loaded.`);
  return fromBase64(globalThis.stepwrightLibrary);
}
