/** Scenes in somebody else's page: elements and a frame under a strict policy, the message API, frames without an origin, lessons from a disk. */
import { mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { expect, type Page, test } from "@playwright/test";
import { unzipSync } from "fflate";
import type { StepwrightScene } from "../../src/embed/element.ts";
import { seriousViolations } from "../support/accessibility.ts";
import { type Site, serve } from "../support/two-sites.mjs";

const BUILT = resolve("dist/site");
const SMALL = JSON.stringify({
  version: 1,
  start: { position: [0, 0], yaw: 0 },
  tasks: [{ id: "turn", category: "turn", position: [0.4, 0, 1.2], yaw: 1.5 }],
});

let host: Site;
const SCENE = "stepwright-scene";
const solved = (page: Page, count: number) =>
  page.waitForFunction(
    (n) =>
      [...document.querySelectorAll<StepwrightScene>("stepwright-scene")].filter((e) => e.quality).length >=
      n,
    count,
    { timeout: 90_000 },
  );

/** What a page tells of broken policies and of errors. */
async function watch(page: Page): Promise<string[]> {
  const broken: string[] = [];
  page.on("pageerror", (e) => broken.push(e.message));
  await page.exposeFunction("noteViolation", (what: string) => broken.push(what));
  await page.addInitScript(() =>
    document.addEventListener("securitypolicyviolation", (e) =>
      (window as unknown as { noteViolation(s: string): void }).noteViolation(
        `${e.violatedDirective} ${e.blockedURI}`,
      ),
    ),
  );
  return broken;
}

test.beforeAll(async () => {
  host = await serve(BUILT, "/course/walks/");
});
test.afterAll(async () => {
  await host.stop();
});

test("two elements and a frame under a strict policy: one worker, messages there and back, strangers unheard", async ({
  page,
}) => {
  const policy = `default-src 'none'; script-src 'self'; connect-src 'self'; worker-src 'self'; style-src 'self'; frame-src ${host.origin}`;
  // The elements' files lie on the page's own origin, the frame comes from another.
  const pages: Record<string, { html: string; policy: string }> = {};
  const mine = await serve(BUILT, "/s/", pages);
  pages["/page.html"] = {
    policy,
    html: `<!doctype html><title>A course</title><script type="module" src="/s/embed/stepwright-element.js"></script>
      <stepwright-scene id="one" controls></stepwright-scene><stepwright-scene id="two" controls panels="steps objective"></stepwright-scene>
      <iframe title="A scene" src="${host.origin}/course/walks/embed.html?origin=${encodeURIComponent(mine.origin)}"></iframe>`,
  };
  try {
    const broken = await watch(page);
    const workers: string[] = [];
    page.on("worker", (w) => workers.push(w.url()));
    await page.goto(`${mine.origin}/page.html`);
    await page.evaluate((scene) => {
      for (const e of document.querySelectorAll("stepwright-scene")) e.setAttribute("scene", scene);
    }, SMALL);
    await solved(page, 2);
    // One planner for both elements; the other origin's frame has its own.
    expect(workers.filter((w) => w.startsWith(`${mine.origin}/s/embed/planner-worker`)).length).toBe(1);
    const element = await page.evaluate(async () => {
      const e = document.querySelector("#one") as StepwrightScene;
      const heard: string[] = [];
      for (const name of ["play", "pause", "timeupdate", "change"])
        e.addEventListener(name, () => heard.push(name));
      e.loop = true;
      e.theme = "dark";
      e.play();
      e.seek(1);
      e.pause();
      e.edit((s) => ({ ...s, seed: 2 }));
      return {
        heard,
        time: e.currentTime,
        loop: e.getAttribute("loop"),
        theme: e.getAttribute("theme"),
        seed: e.scene?.seed,
        where: e.plannedIn,
      };
    });
    expect(element).toEqual({
      heard: ["play", "timeupdate", "pause", "change"],
      time: 1,
      loop: "",
      theme: "dark",
      seed: 2,
      where: "worker",
    });

    const round = await page.evaluate(
      async ([module, origin, scene]) => {
        const { connectFrame } = await import(module);
        const frame = document.querySelector("iframe") as HTMLIFrameElement;
        const api = await connectFrame(frame, origin, 60_000);
        const done = new Promise((r) => void api.on("solved", r));
        await api.load(JSON.parse(scene));
        await done;
        await api.seek(0.5);
        await api.set({ locked: true, speed: 2 });
        const state = await api.state();
        const refused = await api.set({ colour: 1 }).catch((e: Error) => e.message);
        // Another window of this page is no holder: what it posts into the frame is not heard.
        const stranger = document.createElement("iframe");
        document.body.append(stranger);
        const answers: unknown[] = [];
        window.addEventListener("message", (e) => answers.push(e.data));
        frame.contentWindow?.postMessage({ stepwright: 2, id: "v", do: "play" }, origin);
        await api.state();
        return { time: state.time, steps: state.footsteps, where: state.plannedIn, refused, answers };
      },
      [`${mine.origin}/s/embed/stepwright-element.js`, host.origin, SMALL] as const,
    );
    expect(round.time).toBe(0.5);
    expect(round.steps).toBeGreaterThan(2);
    expect(round.where).toBe("worker");
    expect(round.refused).toBe("colour: no such setting is known.");
    expect(round.answers[0]).toEqual({
      stepwright: 1,
      id: "v",
      ok: false,
      error: "stepwright: version 1 is needed, found 2.",
    });
    expect(broken).toEqual([]);

    // A page whose origin the frame was not told of gets no answer at all.
    const wrong = await serve(BUILT, "/none/", {
      "/page.html": {
        policy: `default-src 'none'; frame-src ${host.origin}`,
        html: `<!doctype html><title>A stranger</title><iframe title="A scene" src="${host.origin}/course/walks/embed.html?origin=${encodeURIComponent(mine.origin)}"></iframe>`,
      },
    });
    await page.goto(`${wrong.origin}/page.html`);
    const inside = page.frameLocator("iframe").locator(SCENE);
    await expect(inside).toBeAttached();
    const silent = await page.evaluate(async (origin) => {
      const frame = document.querySelector("iframe") as HTMLIFrameElement;
      const heard: unknown[] = [];
      window.addEventListener("message", (e) => heard.push(e.data));
      frame.contentWindow?.postMessage(
        { stepwright: 1, id: 1, do: "set", values: { theme: "dark" } },
        origin,
      );
      // The frame has dealt with it once a message posted later to this window has come.
      await new Promise((r) => setTimeout(r, 500));
      return heard;
    }, host.origin);
    expect(silent).toEqual([]);
    await expect(inside).not.toHaveAttribute("theme", "dark");
    await wrong.stop();
  } finally {
    await mine.stop();
  }
});

test("a sandboxed frame without an origin, from a host without CORS: planned on the page's own thread", async ({
  page,
}) => {
  const mine = await serve(BUILT, "/none/", {
    "/page.html": {
      policy: `default-src 'none'; frame-src ${host.origin}`,
      html: `<!doctype html><title>A course</title><iframe title="A scene" width="640" height="400" sandbox="allow-scripts" src="${host.origin}/course/walks/embed.html?scene=${encodeURIComponent(SMALL)}"></iframe>`,
    },
  });
  try {
    await page.goto(`${mine.origin}/page.html`);
    const frame = page.frames().find((f) => f.url().includes("embed.html"));
    if (!frame) throw new Error("the frame did not load");
    await frame.waitForFunction(
      () => document.querySelector<StepwrightScene>("stepwright-scene")?.quality,
      null,
      {
        timeout: 120_000,
      },
    );
    const state = await frame.evaluate(() => ({
      origin: self.origin,
      where: document.querySelector<StepwrightScene>("stepwright-scene")?.plannedIn,
      steps: document.querySelector<StepwrightScene>("stepwright-scene")?.plan?.steps.length ?? 0,
    }));
    expect(state.origin).toBe("null");
    expect(state.where).toBe("page");
    expect(state.steps).toBeGreaterThan(2);
  } finally {
    await mine.stop();
  }
});

test("a lesson: the reader drags the goal, resets, prints a link; its zip opens from a disk", async ({
  page,
  context,
}) => {
  const broken = await watch(page);
  await page.goto("/lessons/footsteps-for-a-task.html?wd=0.6&lock=wd");
  const fit = page.locator('[data-figure="fit-steps"]');
  await fit.scrollIntoViewIfNeeded();
  await expect(fit).toHaveAttribute("data-mounted", "true", { timeout: 60_000 });
  const value = page.locator('mn[data-value="f_g"]');
  await expect(value).not.toHaveText("–");
  const before = await value.textContent();
  const goal = fit.getByRole("button", { name: /The goal/ });
  await goal.focus();
  for (let k = 0; k < 6; k++) await page.keyboard.press("Shift+ArrowRight");
  await expect(value).not.toHaveText(before ?? "");
  await expect(fit.getByLabel("Template, wd", { exact: true })).toBeDisabled();
  await expect(fit.getByLabel("Template, wd", { exact: true })).toHaveValue("0.6");
  await fit.getByRole("button", { name: "Reset" }).click();
  await expect(value).toHaveText(before ?? "");

  expect(await seriousViolations(page)).toEqual([]);
  expect(broken).toEqual([]);

  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save offline" }).click(),
  ]);
  const stream = await download.createReadStream();
  const parts: Buffer[] = [];
  for await (const part of stream) parts.push(part as Buffer);
  const folder = resolve("artefacts/offline");
  for (const [name, data] of Object.entries(unzipSync(Buffer.concat(parts)))) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), data);
  }
  const offline = await context.newPage();
  await offline.goto(pathToFileURL(join(folder, "lessons/footsteps-for-a-task.html")).href);
  await offline.locator('[data-figure="fit-steps"]').scrollIntoViewIfNeeded();
  await expect(offline.locator('[data-figure="fit-steps"]')).toHaveAttribute("data-mounted", "true", {
    timeout: 60_000,
  });
  await expect(offline.locator('mn[data-value="f_g"]')).not.toHaveText("–");
  expect(await offline.evaluate(() => getComputedStyle(document.body).fontFamily)).toContain("STIX");
});

test("the embed page has no serious accessibility violation", async ({ page }) => {
  await page.goto(`/embed.html?scene=${encodeURIComponent(SMALL)}`);
  await solved(page, 1);
  expect(await seriousViolations(page)).toEqual([]);
});

for (const file of readdirSync("lessons").filter((f) => f.endsWith(".html")))
  test(`lesson ${file.replace(".html", "")}: no serious accessibility violation, with its figures drawn`, async ({
    page,
  }) => {
    await page.goto(`/lessons/${file}`);
    for (const figure of await page.locator("[data-figure]").all()) {
      await figure.scrollIntoViewIfNeeded();
      await expect(figure).toHaveAttribute("data-mounted", "true", { timeout: 60_000 });
    }
    expect(await seriousViolations(page)).toEqual([]);
  });

for (const [name, path] of [
  ["lessons", "/lessons/index.html"],
  ["lesson-triangles", "/lessons/stepping-by-triangles.html"],
  ["lesson-pendulum", "/lessons/the-pendulum-and-its-search.html"],
  ["embed", `/embed.html?scene=${encodeURIComponent(SMALL)}`],
])
  test(`${name}: nothing is cut off at three sizes, light and dark`, async ({ page }) => {
    await page.goto(path);
    if (name === "embed") await solved(page, 1);
    for (const colorScheme of ["light", "dark"] as const)
      for (const [width, height] of [
        [390, 844],
        [1024, 768],
        [1440, 900],
      ]) {
        await page.setViewportSize({ width, height });
        await page.emulateMedia({ colorScheme });
        const over = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        expect(over, `${name} at ${width}`).toBeLessThanOrEqual(0);
        await page.screenshot({ path: `artefacts/${name}-${width}-${colorScheme}.png` });
      }
  });

test("without WebGL 2: the room from above, with the same footprints and handles", async ({ page }) => {
  await page.addInitScript(() => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (
      this: HTMLCanvasElement,
      kind: string,
      ...rest: unknown[]
    ) {
      return kind.startsWith("webgl") ? null : Reflect.apply(get, this, [kind, ...rest]);
    } as typeof get;
  });
  await page.goto(`/embed.html?scene=${encodeURIComponent(SMALL)}`);
  await solved(page, 1);
  const scene = page.locator(SCENE);
  await expect(scene.getByText(/Seen from above/)).toBeVisible();
  const planned = () =>
    page.evaluate(() => document.querySelector<StepwrightScene>("stepwright-scene")!.plan!.steps.length);
  await expect(scene.locator(".plan .print")).toHaveCount((await planned()) + 2);
  const marker = scene.locator('[data-marker="turn"]');
  const from = (await marker.boundingBox())!;
  await page.mouse.move(from.x + 22, from.y + 22);
  await page.mouse.down();
  await page.mouse.move(from.x - 20, from.y - 10, { steps: 4 });
  await page.mouse.up();
  const moved = await page.evaluate(
    () => document.querySelector<StepwrightScene>("stepwright-scene")!.scene!.tasks[0].position,
  );
  expect(moved[0]).toBeGreaterThan(0.5);
  expect(moved[2]).toBeGreaterThan(1.3);
  // The handle is where the pointer left it.
  const to = (await marker.boundingBox())!;
  expect(Math.abs(to.x - (from.x - 42))).toBeLessThan(2);
  await page.evaluate(() => document.querySelector<StepwrightScene>("stepwright-scene")!.seek(1));
  await page.screenshot({ path: "artefacts/embed-from-above.png" });
});

/** What a minimal element loads before it asks for captures: the module, what that imports at once, and both workers. */
function firstFiles(folder: string): Set<string> {
  const found = new Set<string>();
  const visit = (file: string): void => {
    if (found.has(file)) return;
    found.add(file);
    const text = readFileSync(join(folder, file), "utf8");
    for (const [, path] of text.matchAll(/(?:^|[;}\s])(?:import|from)\s*"(\.\/[^"]+)"/g))
      visit(join(file, "..", path));
  };
  for (const file of ["stepwright-element.js", "planner-worker.js", "mesh-worker.js"]) visit(file);
  return found;
}

test("a minimal element with its workers is at most 350 kB compressed; the captures come when it starts", () => {
  const folder = join(BUILT, "embed");
  const files = [...firstFiles(folder)];
  const sizes = files.map((f) => gzipSync(readFileSync(join(folder, f)), { level: 9 }).length);
  const total = sizes.reduce((a, b) => a + b, 0) / 1000;
  console.log(`element and workers: ${total.toFixed(1)} kB in ${files.length} files`);
  expect(total).toBeGreaterThan(100);
  expect(total).toBeLessThan(350);
  expect(statSync(join(folder, "library.bin")).size).toBeGreaterThan(100_000);
});

test("the editor with what it starts is at most 700 kB compressed", () => {
  const page = readFileSync(join(BUILT, "index.html"), "utf8");
  const listed = [...page.matchAll(/(?:src|href)="\.\/(assets\/[^"]+\.(?:js|css))"/g)].map((m) => m[1]);
  const workers = readdirSync(join(BUILT, "assets")).filter((f) => /^(planner|mesh)-worker.*\.js$/.test(f));
  expect(workers).toHaveLength(2);
  const files = [...new Set([...listed, ...workers.map((f) => `assets/${f}`)])];
  const sizes = files.map((f) => gzipSync(readFileSync(join(BUILT, f)), { level: 9 }).length);
  const total = sizes.reduce((a, b) => a + b, 0) / 1000;
  console.log(`editor and its first workers: ${total.toFixed(1)} kB in ${files.length} files`);
  expect(total).toBeGreaterThan(200);
  expect(total).toBeLessThan(700);
});
