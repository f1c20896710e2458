/** Captures of one's own: opened, labelled at the desk, cleaned, and taken into the library [Oracle §5, §7; TaskLoco §4.1]. */
import { html, nothing, render, svg } from "lit";
import { parseScene } from "../../core/scene/schema.ts";
import { deskKey, deskKeySheet } from "../captures/desk-keys.ts";
import { deskPanel } from "../captures/desk-panel.ts";
import { deskTime } from "../captures/desk-time.ts";
import { captureLayer } from "../captures/layer.ts";
import { CaptureSession } from "../captures/session.ts";
import type { Editor } from "../editor.ts";
import type { ImportFormat } from "../formats/format.ts";
import type { Tool } from "../tools/tool.ts";
import type { Feature } from "./feature.ts";

const sessions = new WeakMap<Editor, CaptureSession>();
const sessionOf = (e: Editor): CaptureSession => {
  const found = sessions.get(e);
  if (!found) throw new Error("The desk has not started.");
  return found;
};

const icon = html`<svg viewBox="0 0 18 18" aria-hidden="true">${svg`<path d="M3 5h6M11 5h4M3 9h3M8 9h7M3 13h8M13 13h2" />`}</svg>`;

const labelTool: Tool = {
  id: "label",
  label: "Labels",
  icon,
  key: "L",
  order: 50,
  enter(e) {
    const s = sessionOf(e);
    e.playback.setPlaying(false);
    // The room as it is, until a capture asks for more; selecting lets it.
    e.stage.setOpen(false);
    e.scene.select([]);
    document.documentElement.dataset.desk = "";
    // The room is the capture's: nothing of the scene is in it.
    e.layers.only("capture");
    e.stage.setFigureShown(true);
    e.stage.showFloor(true);
    e.stage.setScene(parseScene({ version: 1 }), []);
    e.stage.setFootprints([], "category");
    void s.loadPublicList();
    s.changed();
  },
  leave(e) {
    delete document.documentElement.dataset.desk;
    const s = sessionOf(e);
    s.clock.stop();
    e.layers.only(null);
    e.layers.update("scene");
    e.layers.update("plan");
    e.playback.show();
    s.changed();
  },
  keydown: (e, ev) => deskKey(sessionOf(e), ev),
};

const bvh: ImportFormat = {
  id: "bvh-captures",
  label: "Captures",
  endings: [".bvh"],
  open: (e, files) => sessionOf(e).open(files),
};
const csv: ImportFormat = {
  id: "contact-labels",
  label: "Contact labels",
  endings: [".csv"],
  async open(e, files) {
    for (const f of files) await sessionOf(e).openCsv(f);
  },
};
const model: ImportFormat = {
  id: "contact-model",
  label: "Oracle",
  endings: [".bin"],
  async open(e, files) {
    for (const f of files) await sessionOf(e).openModel(f);
  },
};

/** Puts the desk's parts on the page and draws them when something changes. */
function start(e: Editor): void {
  const session = new CaptureSession(e);
  sessions.set(e, session);
  const app = document.querySelector("#app") as HTMLElement;
  const viewport = document.querySelector(".viewport") as HTMLElement;
  const make = (tag: string, name: string, parent: HTMLElement): HTMLElement => {
    const el = document.createElement(tag);
    el.className = name;
    parent.append(el);
    return el;
  };
  const panel = make("aside", "panel desk-panel", app);
  const time = make("footer", "timeline desk-time", app);
  const chips = make("div", "desk-chips", viewport);
  const layer = captureLayer(e, session);
  e.layers.add(layer);
  let drawing = false;
  const draw = (): void => {
    if (drawing) return;
    drawing = true;
    queueMicrotask(() => {
      drawing = false;
      layer.draw();
      if (!session.deskOpen) return;
      const box = time.getBoundingClientRect();
      const size = { width: Math.max(320, box.width - 24), height: Math.max(180, box.height - 56) };
      const c = session.current;
      render(deskPanel(session), panel);
      render(deskTime(session, size), time);
      render(
        c
          ? html`<div class="chip">${c.key} <span class="quiet">frames ${session.stretch.first} to ${session.stretch.last}</span></div>
            <div class="chip keys">${c.edits.brush !== null ? html`<b>Brush ${c.edits.brush ? "plants" : "lifts"}</b>` : nothing}<kbd>1</kbd>–<kbd>4</kbd> track <kbd>←</kbd><kbd>→</kbd> frame <kbd>Space</kbd> paint <kbd>[</kbd><kbd>]</kbd> edge here <kbd>Enter</kbd> confirm, next</div>`
          : nothing,
        chips,
      );
    });
  };
  session.onChange(draw);
  new ResizeObserver(draw).observe(time);
  void session.restore();
}

export const captures: Feature = {
  id: "captures",
  tools: [labelTool],
  imports: [bvh, csv, model],
  keys: deskKeySheet,
  start,
};
