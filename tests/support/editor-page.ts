/** The editor as browser tests use it: opened and planned, given files, watched for errors. */
import type { Page } from "@playwright/test";

/** The newest request for a plan. */
export const newestAsked = (page: Page): Promise<number> =>
  page.evaluate(() =>
    Math.max(0, ...(window.stepwright?.log() ?? []).filter((e) => e.what === "asked").map((e) => e.id)),
  );

/** Waits until a request, or one after it, is answered with its whole motion. */
export const finished = (page: Page, id: number) =>
  page.waitForFunction((n) => window.stepwright?.log().some((e) => e.what === "finished" && e.id >= n), id, {
    timeout: 120_000,
  });

/** Waits until the newest request is answered with its whole motion. */
export const answered = (page: Page) =>
  page.waitForFunction(
    () => {
      const log = window.stepwright?.log() ?? [];
      const newest = Math.max(0, ...log.filter((e) => e.what === "asked").map((e) => e.id));
      return newest > 0 && log.some((e) => e.what === "finished" && e.id === newest);
    },
    null,
    { timeout: 120_000 },
  );

/** Opens the editor with the plan of its first scene made; the character does not start by itself. */
export async function openEditor(page: Page): Promise<void> {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto("/");
  await answered(page);
}

export interface TestFile {
  name: string;
  content: string | Buffer;
}

/** Lets files go over the page, as from a folder. */
export const drop = (page: Page, ...files: TestFile[]): Promise<void> =>
  page.evaluate(
    (list) => {
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of list)
        dataTransfer.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    },
    files.map(({ name, content }) => ({ name, bytes: Buffer.from(content).toString("base64") })),
  );

/** Messages of errors that the page lets through, from now on. */
export function pageErrors(page: Page): string[] {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  return errors;
}
