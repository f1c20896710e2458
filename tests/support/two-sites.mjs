/**
 * Two static sites for the browser tests of the embed: one serves the built site under a path of its own and sends no CORS headers, the
 * other is somebody else's page with a strict policy. Their addresses differ in origin.
 */
import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";

const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".json": "application/json",
  ".svg": "image/svg+xml",
};

/** @returns the server's address and what stops it. `pages` maps paths to HTML with its policy; the rest comes from `folder` under `base`. */
export function serve(folder, base, pages = {}, headers = {}) {
  return new Promise((resolve) => {
    const server = createServer((request, response) => {
      const path = new URL(request.url ?? "/", "http://x").pathname;
      const page = pages[path];
      if (page) {
        response.writeHead(200, { "Content-Type": "text/html", "Content-Security-Policy": page.policy });
        response.end(page.html);
        return;
      }
      const file = path.startsWith(base) ? join(folder, normalize(path.slice(base.length))) : "";
      if (!file?.startsWith(folder) || !existsSync(file) || !statSync(file).isFile()) {
        response.writeHead(404);
        response.end();
        return;
      }
      response.writeHead(200, {
        "Content-Type": TYPES[extname(file)] ?? "application/octet-stream",
        ...headers,
      });
      createReadStream(file).pipe(response);
    });
    server.listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      resolve({
        origin: `http://127.0.0.1:${port}`,
        port,
        stop: () => new Promise((done) => server.close(done)),
      });
    });
  });
}
