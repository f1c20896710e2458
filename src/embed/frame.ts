/**
 * The page inside a frame (`embed.html`): one element over the whole window.
 *
 * Its address says what to show: `src` or `scene` (a document as JSON), `panels`, `autoplay`, `loop`, `locked`, `theme`, `bar=off`
 * and `origin`, once for each page that may talk to it (its own origin always may).
 */
import { defineElement } from "./define.ts";
import { listen } from "./frame-api.ts";
import { configure } from "./resources.ts";
import { startOnce } from "./start-once.ts";

function start(): void {
  const query = new URLSearchParams(location.search);
  configure({
    library: new URL("generated/library.bin", location.href).href,
    editor: new URL("./", location.href).href,
  });
  defineElement();
  const element = document.createElement("stepwright-scene");
  for (const name of ["src", "scene", "panels", "theme"])
    if (query.has(name)) element.setAttribute(name, query.get(name) ?? "");
  for (const name of ["autoplay", "loop", "locked"]) element.toggleAttribute(name, query.has(name));
  element.toggleAttribute("controls", query.get("bar") !== "off");
  document.body.append(element);
  listen(element, [new URL(location.href).origin, ...query.getAll("origin")]);
}

if (document.documentElement.dataset.page === "embed") startOnce("embed", start);
