import { existsSync, readdirSync } from "node:fs";
import { defineConfig } from "vite";
import { siteExtras } from "./src/cli/extras-plugin.ts";
import { lessonPages } from "./src/cli/lesson-plugin.ts";
import { shippedLibrary } from "./src/cli/library-plugin.ts";
import { noticeAll, siteSafety } from "./src/cli/site-plugin.ts";

/** Every page of the site: those at the top, and the lessons. */
function pages(): string[] {
  const lessons = existsSync("lessons") ? readdirSync("lessons").filter((f) => f.endsWith(".html")) : [];
  return ["index.html", "embed.html", "studio.html", ...lessons.map((f) => `lessons/${f}`)];
}

export default defineConfig({
  base: "./",
  plugins: [lessonPages(), shippedLibrary(), siteSafety(), noticeAll(), siteExtras()],
  worker: { format: "es", plugins: () => [noticeAll()] },
  server: { port: 5173 },
  preview: { port: 4173 },
  build: {
    target: "es2022",
    outDir: "dist/site",
    chunkSizeWarningLimit: 1200,
    rolldownOptions: { input: pages() },
  },
});
