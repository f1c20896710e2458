/**
 * A lesson's page: puts its figures in when they come near, follows the reader in the contents, prints, saves the lesson for offline
 * use. Without it the page is plain text with formulas.
 */
import { defineElement } from "../embed/define.ts";
import { el, setAttributes } from "../embed/dom.ts";
import { configure } from "../embed/resources.ts";
import { startOnce } from "../embed/start-once.ts";
import { FIGURES } from "./figures/all.ts";
import { Parameters } from "./kit/parameters.ts";
import { LESSON_SCENES } from "./scenes.ts";

/** A figure this near to the screen is made, CSS pixels. */
const NEAR = "500px";

function say(text: string): void {
  document.querySelector(".say")?.remove();
  const note = el("p", { class: "say", role: "status" }, text);
  document.body.append(note);
  setTimeout(() => note.remove(), 6000);
}

/** The part of the lesson that is read now, marked in the contents. */
function followReader(): void {
  const links = [...document.querySelectorAll<HTMLAnchorElement>(".contents a")];
  const heads = links.flatMap((a) => document.getElementById(a.hash.slice(1)) ?? []);
  const mark = (): void => {
    let now = 0;
    heads.forEach((h, i) => {
      if (h.getBoundingClientRect().top < innerHeight * 0.35) now = i;
    });
    links.forEach((a, i) => {
      if (i === now) a.setAttribute("aria-current", "true");
      else a.removeAttribute("aria-current");
    });
  };
  if (heads.length === 0) return;
  addEventListener("scroll", mark, { passive: true });
  mark();
}

function mountFigures(parameters: Parameters): void {
  const mount = (figure: HTMLElement): void => {
    const name = figure.dataset.figure ?? "";
    const box = el("div", { class: "drawing" });
    figure.prepend(box);
    const load = FIGURES[name];
    if (!load) throw new Error(`${name}: no such figure is known.`);
    const made = async (): Promise<void> => {
      const make = await load();
      await make({ figure, box, parameters });
      addResets(figure, box, parameters);
      figure.dataset.mounted = "true";
    };
    made().catch((error: unknown) => {
      box.append(el("p", { class: "finding" }, error instanceof Error ? error.message : String(error)));
    });
  };
  const near = new IntersectionObserver(
    (entries) => {
      for (const e of entries)
        if (e.isIntersecting) {
          near.unobserve(e.target);
          mount(e.target as HTMLElement);
        }
    },
    { rootMargin: NEAR },
  );
  for (const f of document.querySelectorAll<HTMLElement>("[data-figure]")) near.observe(f);
}

/** Formulas wider than their column are scrolled to the side: by keys too, so they take the focus then. */
function reachFormulas(): void {
  for (const formula of document.querySelectorAll(".equation")) {
    const watch = new ResizeObserver(() => {
      const wide = formula.scrollWidth > formula.clientWidth + 1;
      setAttributes(formula, {
        tabindex: wide ? 0 : null,
        role: wide ? "group" : null,
        "aria-label": wide ? "Formula" : null,
      });
    });
    watch.observe(formula);
    // Its numbers grow when a figure fills them in.
    for (const part of formula.children) watch.observe(part);
  }
}

/** "Reset" under every figure that has something to change, and a link to its present state for teachers. */
function addResets(figure: HTMLElement, box: HTMLElement, parameters: Parameters): void {
  if (!box.querySelector(".handle, input, .segments, stepwright-scene")) return;
  const reset = el("button", { class: "act", type: "button" }, "Reset");
  reset.addEventListener("click", () => {
    parameters.reset();
    for (const scene of figure.querySelectorAll("stepwright-scene")) scene.reset();
  });
  const link = el("button", { class: "act", type: "button" }, "Copy link to this state");
  link.addEventListener("click", () => {
    const address = new URL(location.href);
    address.search = parameters.queryText();
    address.hash = figure.id;
    navigator.clipboard.writeText(address.href).then(
      () => say("The link is copied. Add &lock=all to it to lock what can be moved."),
      () => say(address.href),
    );
  });
  box.append(el("div", { class: "row" }, reset, link));
}

/** Elements that name one of the lessons' scenes get it. */
function fillScenes(): void {
  for (const element of document.querySelectorAll("stepwright-scene")) {
    const scene = LESSON_SCENES[element.dataset.scene ?? ""];
    if (scene) element.setAttribute("scene", JSON.stringify(scene()));
  }
}

function start(): void {
  configure({
    library: new URL("../generated/library.bin", location.href).href,
    libraryScript: new URL("../offline/library.js", location.href).href,
    editor: new URL("../", location.href).href,
  });
  const query = new URLSearchParams(location.search);
  const parameters = new Parameters(query);
  if (parameters.locked("scene"))
    for (const s of document.querySelectorAll("stepwright-scene")) s.setAttribute("locked", "");
  fillScenes();
  defineElement();
  followReader();
  mountFigures(parameters);
  reachFormulas();
  document.querySelector('[data-act="print"]')?.addEventListener("click", () => print());
  document.querySelector('[data-act="zip"]')?.addEventListener("click", () => {
    say("Collecting the lesson.");
    import("./offline-zip.ts")
      .then(({ saveLesson }) => saveLesson())
      .then(
        (name) => say(`${name} is saved. Unpack it and open the page inside; it needs no network.`),
        (error: unknown) => say(error instanceof Error ? error.message : String(error)),
      );
  });
}

if (document.documentElement.dataset.page === "lesson") startOnce("lesson", start);
