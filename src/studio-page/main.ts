/** The studio page: sliders, a person who walks by them, and the gait's curves before those of real walkers. */
import { html, nothing, render, type TemplateResult } from "lit";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import { insideShare } from "../plots/gait-curves.ts";
import { LAYERS } from "../studio/score.ts";
import type { Style } from "../studio/styles.ts";
import type { WalkSettings } from "../studio/walk-score.ts";
import { COARSE } from "../view/character/fineness.ts";
import { Stage } from "../view/stage.ts";
import type { Theme } from "../view/tokens.ts";
import type { MeshRequest, MeshResponse } from "../workers/mesh-worker.ts";
import type { Walked } from "../workers/studio-protocol.ts";
import { controls, layerRows } from "./controls.ts";
import { curves, factRows, jointPlots } from "./curves.ts";
import { Player } from "./player.ts";
import { inStyle, START } from "./settings.ts";
import { WalkSession } from "./walk-session.ts";

export interface PageState {
  settings: WalkSettings;
  /** The style that the settings were taken from and have not left since. */
  style: Style | "own";
  /** Text of a loaded score and its name; null while the sliders lead. */
  score: { name: string; text: string } | null;
  walk: Walked | null;
  theme: Theme;
  playing: boolean;
  table: boolean;
  message: string | null;
}

declare global {
  interface Window {
    /** What the page shows, for tests. */
    stepwrightStudio?: { state(): PageState; walks(): number };
  }
}

function element<E extends Element>(selector: string): E {
  const e = document.querySelector<E>(selector);
  if (!e) throw new Error(`${selector} is missing in the page.`);
  return e;
}

class StudioPage {
  private readonly stage: Stage | null;
  private readonly player: Player | null;
  private readonly session: WalkSession;
  private readonly meshes = new Worker(new URL("../workers/mesh-worker.ts", import.meta.url), {
    type: "module",
  });
  private meshId = 0;
  private meshAsked = "";
  private walks = 0;
  state: PageState;

  constructor() {
    // What stood there before the script is drawn anew.
    element<HTMLElement>(".top-bar").textContent = "";
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.state = {
      settings: START,
      style: "walking",
      score: null,
      walk: null,
      theme: dark ? "dark" : "light",
      playing: !still,
      table: false,
      message: null,
    };
    const canvas = element<HTMLCanvasElement>("#stage");
    this.stage = this.openStage(canvas);
    this.player = this.stage ? new Player(this.stage) : null;
    if (this.player) this.player.playing = this.state.playing;
    this.meshes.onmessage = (event: MessageEvent<MeshResponse>) => {
      const { walk } = this.state;
      if (event.data.id !== this.meshId || !walk) return;
      this.stage?.setCharacter(createSkeleton(walk.height, walk.proportions), event.data.mesh);
      this.player?.show();
      if (event.data.fineness > 1) this.askSkin(walk, 1);
    };
    this.meshes.onerror = (event) => {
      event.preventDefault();
      this.set({ message: "The person cannot be drawn: its worker stopped. Reload the page." });
    };
    this.session = new WalkSession({
      walked: (walk) => this.walked(walk),
      saved: (name, text) => download(name, text),
      failed: (message) => this.set({ message }),
    });
    this.setTheme(this.state.theme);
    if (this.stage) {
      const adapt = () =>
        this.stage?.resize(canvas.clientWidth, canvas.clientHeight, { left: 0, top: 0, right: 0, bottom: 0 });
      new ResizeObserver(adapt).observe(element(".viewport"));
      adapt();
    }
    window.addEventListener("keydown", (e) => {
      if (e.key !== " " || (e.target instanceof Element && e.target.closest("input, button, select, a")))
        return;
      e.preventDefault();
      this.togglePlaying();
    });
    window.stepwrightStudio = { state: () => this.state, walks: () => this.walks };
    this.session.walk(this.state.settings);
    this.draw();
  }

  private openStage(canvas: HTMLCanvasElement): Stage | null {
    try {
      const stage = new Stage(canvas);
      stage.onLost = () =>
        this.set({
          message: "The browser has taken the drawing away and does not give it back. Reload the page.",
        });
      return stage;
    } catch (error) {
      console.warn(error);
      this.state.message = "This browser has no WebGL 2: the curves are shown, the person is not.";
      return null;
    }
  }

  set(change: Partial<PageState>): void {
    this.state = { ...this.state, ...change };
    this.draw();
  }

  /** Settings changed by hand: the style is left, a loaded score put aside. */
  settle(settings: WalkSettings, style: PageState["style"] = "own"): void {
    const layersOnly = this.state.score !== null && settings.without !== this.state.settings.without;
    this.state = {
      ...this.state,
      settings,
      style,
      score: layersOnly ? this.state.score : null,
      message: null,
    };
    if (this.state.score) this.session.score(this.state.score.text, settings.without);
    else this.session.walk(settings);
    this.draw();
  }

  takeStyle(style: Style): void {
    this.settle(inStyle(this.state.settings, style), style);
  }

  async open(file: File | undefined): Promise<void> {
    if (!file) return;
    const text = await file.text();
    this.state = { ...this.state, score: { name: file.name, text }, message: null };
    this.session.score(text, this.state.settings.without);
    this.draw();
  }

  save(what: "bvh" | "score"): void {
    this.session.save(what);
  }

  togglePlaying(): void {
    const playing = !this.state.playing;
    if (this.player) this.player.playing = playing;
    this.set({ playing });
  }

  frame(): void {
    this.player?.frame();
  }

  setTheme(theme: Theme): void {
    document.documentElement.dataset.theme = theme;
    this.stage?.setTheme(theme);
    this.set({ theme });
  }

  private askSkin({ height, proportions }: Walked, fineness: number): void {
    const request: MeshRequest = { id: this.meshId, height, proportions, fineness };
    this.meshes.postMessage(request);
  }

  private walked(walk: Walked): void {
    this.walks++;
    const key = JSON.stringify([walk.height, walk.proportions]);
    if (this.stage && key !== this.meshAsked) {
      this.meshAsked = key;
      this.meshId++;
      this.askSkin(walk, COARSE);
    }
    this.player?.set(walk);
    this.set({ walk });
    const inside = walk.gait ? jointPlots(walk).map(insideShare) : [];
    element("#live").textContent = walk.gait
      ? `${walk.gait.facts.speed.toFixed(2)} metres a second, ${walk.gait.facts.cadence.toFixed(0)} steps a minute${inside.every((v) => v !== null) ? `; hip, knee and ankle ${inside.map((v) => Math.round(100 * (v ?? 0))).join(", ")} % inside the real range` : ""}.`
      : "No steady gait.";
  }

  private draw(): void {
    render(this.topBar(), element<HTMLElement>(".top-bar"));
    render(this.panel(), element<HTMLElement>(".panel"));
    render(
      curves(this.state, (table) => this.set({ table })),
      element<HTMLElement>(".curves"),
    );
    render(this.overlay(), this.overlayHost());
  }

  private overlayHost(): HTMLElement {
    const at = document.querySelector<HTMLElement>(".over-stage");
    if (at) return at;
    const made = document.createElement("div");
    made.className = "over-stage";
    element(".viewport").append(made);
    return made;
  }

  private overlay(): TemplateResult {
    const { walk, playing, message } = this.state;
    return html`
      <div class="transport">
        <button class="icon raised" aria-label=${playing ? "Pause" : "Play"} title="Space" @click=${() => this.togglePlaying()}>
          ${playing ? html`<svg viewBox="0 0 18 18"><path d="M6 4v10M12 4v10" /></svg>` : html`<svg viewBox="0 0 18 18"><path d="M6 4l8 5-8 5z" /></svg>`}
        </button>
        <button class="icon raised" aria-label="Frame the walk" title="Frame the walk" @click=${() => this.frame()}>
          <svg viewBox="0 0 18 18"><path d="M3 7V3h4M11 3h4v4M15 11v4h-4M7 15H3v-4" /></svg>
        </button>
      </div>
      ${walk?.gait ? html`<dl class="facts">${factRows(walk).map((r) => html`<div class=${r.out ? "out" : ""}><dt>${r.name}</dt><dd>${r.value}</dd></div>`)}</dl>` : nothing}
      ${message ? html`<p class="message" role="alert">${message}</p>` : nothing}
    `;
  }

  private topBar(): TemplateResult {
    const { theme, score } = this.state;
    return html`
      <span class="mark" aria-hidden="true"></span><strong>Stepwright</strong>
      <a class="plain" href="./index.html">Editor</a><span class="here" aria-current="page">Studio</span>
      <span class="quiet">${score ? score.name : ""}</span>
      <span class="space"></span>
      <button class="icon" aria-label=${theme === "light" ? "Dark theme" : "Light theme"} @click=${() => this.setTheme(theme === "light" ? "dark" : "light")}>
        <svg viewBox="0 0 18 18">${theme === "light" ? html`` : nothing}<path d="M9 2.5a6.5 6.5 0 106.5 6.5A5 5 0 019 2.5z" /></svg>
      </button>
      <label class="button file">Open score<input type="file" accept=".json,application/json" class="visually-hidden" @change=${(
        e: Event,
      ) => {
        const input = e.target as HTMLInputElement;
        void this.open(input.files?.[0]);
        input.value = "";
      }} /></label>
      <button class="button" ?disabled=${!this.state.walk} @click=${() => this.save("score")}>Save score</button>
      <button class="button primary" ?disabled=${!this.state.walk} @click=${() => this.save("bvh")}>Save BVH</button>
    `;
  }

  private panel(): TemplateResult {
    const { walk, settings } = this.state;
    return html`<div class="body">
      ${controls(this.state, {
        settle: (s) => this.settle(s),
        takeStyle: (s) => this.takeStyle(s),
      })}
      <div class="section layers">
        <header><h3>Layers</h3><span>${LAYERS.length - settings.without.length} of ${LAYERS.length} on</span></header>
        ${layerRows(walk, settings, (s) => this.settle(s, this.state.style))}
      </div>
    </div>`;
  }
}

/** Gives the user a text as a file. */
function download(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "application/octet-stream" }));
  const a = document.createElement("a");
  a.href = url;
  a.download = name;
  a.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

new StudioPage();
