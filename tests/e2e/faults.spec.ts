/** What goes wrong in browsers: the page says so, goes on, and loses nothing. */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { expect, type Page, test } from "@playwright/test";
import { answered, drop, pageErrors } from "../support/editor-page.ts";

const finishedCount = (page: Page): Promise<number> =>
  page.evaluate(() => window.stepwright?.log().filter((e) => e.what === "finished").length ?? 0);
/** The picture once it has come to rest: two screenshots in a row are the same. */
async function restingBrightness(page: Page, path: string): Promise<number> {
  let before = Number.NaN;
  await expect
    .poll(
      async () => {
        const now = await brightness(page, path);
        const same = now === before;
        before = now;
        return same;
      },
      { timeout: 60_000 },
    )
    .toBe(true);
  return before;
}

/** Mean brightness of the room's picture, 0 to 255. */
async function brightness(page: Page, path: string): Promise<number> {
  const png = await page.locator("#stage").screenshot({ path });
  return page.evaluate(
    async (data) => {
      const image = new Image();
      image.src = data;
      await image.decode();
      const canvas = document.createElement("canvas");
      canvas.width = image.width;
      canvas.height = image.height;
      const context = canvas.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(image, 0, 0);
      const { data: pixels } = context.getImageData(0, 0, image.width, image.height);
      let sum = 0;
      for (let i = 0; i < pixels.length; i += 4) sum += pixels[i] + pixels[i + 1] + pixels[i + 2];
      return sum / (0.75 * pixels.length);
    },
    `data:image/png;base64,${png.toString("base64")}`,
  );
}

test("a policy without eval or inline scripts, which the page keeps to", async ({ page }) => {
  const broken: string[] = [];
  await page.exposeFunction("noteViolation", (what: string) => broken.push(what));
  await page.addInitScript(() => {
    document.addEventListener("securitypolicyviolation", (e) =>
      (window as unknown as { noteViolation(s: string): void }).noteViolation(
        `${e.violatedDirective} ${e.blockedURI}`,
      ),
    );
  });
  await page.goto("/");
  await answered(page);
  const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute("content");
  expect(policy).toContain("script-src 'self';");
  expect(policy).not.toContain("unsafe-eval");
  expect(policy?.replace("style-src-attr 'unsafe-inline'", "")).not.toContain("unsafe-inline");
  expect(broken).toEqual([]);
  // It is in force: a script put into the page does not run.
  await page.evaluate(() => {
    const s = document.createElement("script");
    s.textContent = "window.injected = true";
    document.body.append(s);
  });
  expect(await page.evaluate(() => "injected" in window)).toBe(false);
  const told = await (await page.request.get("/THIRD-PARTY-NOTICES.txt")).text();
  for (const name of ["three", "lit", "valibot", "idb", "@fontsource-variable/geist"])
    expect(told).toMatch(new RegExp(`^${name} \\d+\\.\\d+\\.\\d+ \\(`, "m"));
});

test("storage closed and corrupt, markup in names, a lost drawing context, a planner killed at work", async ({
  page,
}) => {
  const errors = pageErrors(page);
  // What another version left behind is no scene.
  await page.goto("/favicon.svg");
  await page.evaluate(
    () =>
      new Promise<void>((resolve, reject) => {
        const r = indexedDB.open("stepwright", 1);
        r.onupgradeneeded = () => r.result.createObjectStore("scenes");
        r.onerror = () => reject(r.error);
        r.onsuccess = () => {
          const t = r.result.transaction("scenes", "readwrite");
          t.objectStore("scenes").put({ version: 1, tasks: "none" }, "current");
          t.oncomplete = () => {
            r.result.close();
            resolve();
          };
        };
      }),
  );
  await page.goto("/");
  await answered(page);
  expect(await page.evaluate(() => window.stepwright?.state().scene.tasks.length)).toBe(4);

  // Markup in a file's name and in its ids stays text.
  const evil = '<img src=x onerror="window.injected=true">';
  await drop(page, { name: `${evil}.json`, content: "{" });
  await expect(page.getByText("no JSON").first()).toBeVisible();
  await drop(page, {
    name: `${evil}.json`,
    content: JSON.stringify({
      version: 1,
      tasks: [{ id: evil, category: "write", position: [0, 1.3, 2] }],
      props: [{ id: `${evil}2`, kind: "board", position: [0, 1.5, 2] }],
    }),
  });
  await page.waitForFunction(() => window.stepwright?.state().scene.tasks.length === 1);
  await page.waitForFunction(() => (window.stepwright?.state().plan?.tasks.length ?? 0) === 1);
  expect(await page.locator("img[src=x]").count()).toBe(0);
  expect(await page.evaluate(() => "injected" in window)).toBe(false);

  // The planner dies while it works: the newest scene is planned all the same.
  const before = await finishedCount(page);
  await page.evaluate(() => window.stepwright?.restartPlanner());
  await expect.poll(() => finishedCount(page), { timeout: 60_000 }).toBeGreaterThan(before);

  // The drawing context is lost and comes back: the picture is as bright as before, with nothing lying over it.
  await expect(page.locator(".toast")).toHaveCount(0, { timeout: 15_000 });
  await page.evaluate(() => window.stepwright?.seek(1));
  const bright = await restingBrightness(page, "artefacts/context-before.png");
  const lost = await page.evaluate(async () => {
    const canvas = document.querySelector("#stage") as HTMLCanvasElement;
    const gl = canvas.getContext("webgl2");
    const extension = gl?.getExtension("WEBGL_lose_context");
    if (!gl || !extension) return "no extension";
    const until = (event: string) => new Promise((r) => canvas.addEventListener(event, r, { once: true }));
    const gone = until("webglcontextlost");
    extension.loseContext();
    await gone;
    const back = until("webglcontextrestored");
    // The event must have been dealt with before the context may come back.
    setTimeout(() => extension.restoreContext(), 50);
    await back;
    // Nobody asks for a picture: it is drawn anew because the context is back.
    await new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)));
    return gl.isContextLost() ? "lost" : "back";
  });
  expect(lost).toBe("back");
  const after = await restingBrightness(page, "artefacts/context-restored.png");
  expect(bright).toBeGreaterThan(40);
  expect(Math.abs(after - bright)).toBeLessThan(2);
  expect(errors).toEqual([]);
});

test("storage closed: the page works and says that nothing is kept", async ({ page }) => {
  await page.addInitScript(() => {
    IDBFactory.prototype.open = () => {
      throw new DOMException("closed", "SecurityError");
    };
  });
  await page.goto("/");
  await answered(page);
  await page.locator('[data-marker="write"]').focus();
  await page.keyboard.press("r");
  await page.waitForFunction(() => window.stepwright?.state().saved === "off");
  expect(await page.evaluate(() => window.stepwright?.state().scene.tasks.length)).toBe(4);
});

test("what the built pages point to is there: the server answers for what is not with the editor", () => {
  const site = join("dist", "site");
  const pages = readdirSync(site, { recursive: true, encoding: "utf8" }).filter((f) => f.endsWith(".html"));
  expect(pages.length).toBeGreaterThan(8);
  expect(existsSync(join(site, "THIRD-PARTY-NOTICES.txt"))).toBe(true);
  const missing = pages.flatMap((page) =>
    [...readFileSync(join(site, page), "utf8").matchAll(/\s(?:href|src)="([^"#?]+)/g)]
      .map(([, to]) => to)
      .filter((to) => !/^[a-z]+:/.test(to) && !existsSync(join(site, dirname(page), to)))
      .map((to) => `${page}: ${to}`),
  );
  expect([...new Set(missing)]).toEqual([]);
});
