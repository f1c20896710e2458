/** A lesson as a zip that works from a disk: its page, fonts, the classic script and the captures. */
import { strToU8, zipSync } from "fflate";

/** What is compressed already gains nothing. */
const STORED = /\.(woff2|js)$/;

async function bytes(address: string): Promise<Uint8Array> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: could not be read (${answer.status}).`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** Where an address lies in the zip: its way from the site's top. */
function place(address: string, top: string): string {
  return decodeURIComponent(new URL(address).pathname.slice(new URL(top).pathname.length));
}

/** The page for a disk: no modules, which browsers do not load from there; its policy names no origin. */
export function offlinePage(html: string): { html: string; styles: string[] } {
  const page = new DOMParser().parseFromString(html, "text/html");
  for (const e of page.querySelectorAll(
    'script[type="module"], link[rel="modulepreload"], meta[http-equiv="Content-Security-Policy"], [data-act="zip"]',
  ))
    e.remove();
  const styles = [...page.querySelectorAll('link[rel="stylesheet"]')].map((l) => {
    // Cross-origin rules do not hold for files.
    l.removeAttribute("crossorigin");
    return l.getAttribute("href") ?? "";
  });
  return { html: `<!doctype html>\n${page.documentElement.outerHTML}\n`, styles };
}

/** Everything in the zip of the lesson at an address. @throws Error that names what could not be read. */
export async function lessonFiles(address: string): Promise<Record<string, Uint8Array>> {
  const top = new URL("../", address).href;
  const text = new TextDecoder().decode(await bytes(address));
  const page = offlinePage(text);
  const files: Record<string, Uint8Array> = { [place(address, top)]: strToU8(page.html) };
  const add = async (at: string): Promise<Uint8Array> => {
    const data = await bytes(at);
    files[place(at, top)] = data;
    return data;
  };
  for (const href of page.styles) {
    const at = new URL(href, address).href;
    const css = new TextDecoder().decode(await add(at));
    const fonts = [...css.matchAll(/url\(["']?([^"')]+)["']?\)/g)].map((m) => m[1]);
    for (const font of new Set(fonts)) if (!font.startsWith("data:")) await add(new URL(font, at).href);
  }
  for (const name of [
    "favicon.svg",
    "offline/boot.js",
    "offline/stepwright.js",
    "offline/library.js",
    "THIRD-PARTY-NOTICES.txt",
  ])
    await add(new URL(name, top).href);
  return files;
}

/** Saves the lesson that is shown. @returns the file's name. */
export async function saveLesson(): Promise<string> {
  const address = new URL(location.href);
  address.search = "";
  address.hash = "";
  const files = await lessonFiles(address.href);
  const zip = zipSync(
    Object.fromEntries(
      Object.entries(files).map(([name, data]) => [name, [data, { level: STORED.test(name) ? 1 : 6 }]]),
    ),
  );
  const name = `stepwright-${address.pathname
    .split("/")
    .pop()
    ?.replace(/\.html$/, "")}.zip`;
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([zip as Uint8Array<ArrayBuffer>], { type: "application/zip" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  return name;
}
