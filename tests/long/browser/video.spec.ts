/** The video export, read back by the browser's own player. Long where pictures are drawn without a graphics card. */
import { readFile } from "node:fs/promises";
import { expect, test } from "@playwright/test";
import { answered, drop, openEditor } from "../../support/editor-page.ts";

test("a video of the viewport plays: as long as the motion, as large as the room, and it moves", async ({
  page,
  context,
}) => {
  // Small pictures, drawn quickly without a graphics card.
  await page.setViewportSize({ width: 420, height: 700 });
  await openEditor(page);
  await drop(page, {
    name: "turn.json",
    content: JSON.stringify({
      version: 1,
      tasks: [{ id: "turn", category: "turn", position: [0, 0, 0], yaw: 1.2 }],
    }),
  });
  await page.waitForFunction(() => window.stepwright!.state().scene.tasks[0]?.id === "turn");
  await answered(page);
  await page.getByRole("button", { name: "More", exact: true }).click();
  const [file] = await Promise.all([
    page.waitForEvent("download", { timeout: 900_000 }),
    page.getByRole("menuitem", { name: "Video of the viewport (WebM)" }).click(),
  ]);
  expect(file.suggestedFilename()).toBe("turn.webm");
  const video = await readFile(await file.path());
  const { duration, width, height } = await page.evaluate(() => {
    const { width: w, height: h } = document.querySelector<HTMLCanvasElement>("#stage")!;
    return { duration: window.stepwright!.state().plan!.duration, width: w & ~1, height: h & ~1 };
  });
  // The browser's own player is the reader.
  const player = await context.newPage();
  const seen = await player.evaluate(
    async (source) => {
      const v = document.createElement("video");
      v.muted = true;
      v.src = source;
      const once = (name: string) =>
        new Promise((done, fail) => {
          v.addEventListener(name, done, { once: true });
          v.addEventListener("error", () => fail(new Error(v.error?.message)), { once: true });
        });
      await once("loadeddata");
      const canvas = document.createElement("canvas");
      canvas.width = v.videoWidth;
      canvas.height = v.videoHeight;
      const context2d = canvas.getContext("2d", { willReadFrequently: true })!;
      const frames: Uint8ClampedArray[] = [];
      for (const part of [0.1, 0.5, 0.9]) {
        v.currentTime = part * v.duration;
        await once("seeked");
        context2d.drawImage(v, 0, 0);
        frames.push(context2d.getImageData(0, 0, canvas.width, canvas.height).data);
      }
      const differing = (a: Uint8ClampedArray, b: Uint8ClampedArray) =>
        a.reduce((n, x, i) => n + (Math.abs(x - b[i]) > 24 ? 1 : 0), 0);
      return {
        duration: v.duration,
        width: v.videoWidth,
        height: v.videoHeight,
        shades: new Set(frames[0]).size,
        moved: [differing(frames[0], frames[1]), differing(frames[1], frames[2])],
      };
    },
    `data:video/webm;base64,${video.toString("base64")}`,
  );
  await player.close();
  expect(Math.abs(seen.duration - duration)).toBeLessThan(0.1);
  expect([seen.width, seen.height]).toEqual([width, height]);
  expect(seen.shades).toBeGreaterThan(50);
  for (const n of seen.moved) expect(n).toBeGreaterThan(200);
});
