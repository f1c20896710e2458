import { defineConfig } from "vite";
import { shippedLibrary } from "./src/cli/library-plugin.ts";
import { siteSafety } from "./src/cli/site-plugin.ts";

export default defineConfig({
  base: "./",
  plugins: [shippedLibrary(), siteSafety()],
  worker: { format: "es" },
  server: { port: 5173 },
  preview: { port: 4173 },
  build: {
    target: "es2022",
    outDir: "dist/site",
    chunkSizeWarningLimit: 1200,
    rollupOptions: { input: ["index.html", "studio.html"] },
  },
});
