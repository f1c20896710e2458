/**
 * `<stepwright-scene>`: a scene that plays, and whose tasks can be dragged, in any page.
 *
 * Attributes, each with a property of the same name: `src` (address of a scene document), `scene` (the document itself; the
 * property takes and gives the object), `controls`, `panels` (names, spaces between: `steps`, `objective`, `templates`, `quality`),
 * `autoplay`, `loop`, `locked` (nothing can be dragged), `theme` (`light` or `dark`; otherwise as the system).
 *
 * Events: `ready` (drawn, and the planner answers), `planned`, `solved`, `timeupdate`, `play`, `pause`, `ended`, `change` and
 * `error`; what they carry in `detail` is in `SceneEventDetails`.
 */
import type { QualityFigures } from "../core/motion/types.ts";
import { defaultScene } from "../core/scene/default-scene.ts";
import { parseScene, readScene, serializeScene } from "../core/scene/schema.ts";
import type { Scene } from "../core/scene/types.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import { el } from "./dom.ts";
import { icon } from "./icons.ts";
import { drawOn, type Picture } from "./picture.ts";
import { Player } from "./player.ts";
import { places } from "./resources.ts";
import { Strip } from "./strip.ts";
import { STYLES } from "./styles.ts";
import { TaskMarkers } from "./task-markers.ts";

/** What the element's events carry. */
export interface SceneEventDetails {
  ready: null;
  planned: { plan: Plan };
  solved: { quality: QualityFigures };
  timeupdate: { time: number; duration: number };
  play: null;
  pause: null;
  ended: null;
  change: { scene: Scene };
  error: { message: string };
}

const ATTRIBUTES = ["src", "scene", "controls", "panels", "autoplay", "loop", "locked", "theme"] as const;
/** Pictures kept at a time: browsers allow some sixteen drawing contexts. */
const MOST_PICTURES = 8;
/** Name of the performance mark that each element sets when it has drawn for the first time. */
export const FIRST_RENDER = "stepwright-first-render";
/** An element this near to the screen gets its picture, CSS pixels. */
const NEAR = "300px";

/** Node and server rendering know no elements: the class can be imported there, and is not used. */
const Base: typeof HTMLElement = globalThis.HTMLElement ?? (class {} as unknown as typeof HTMLElement);

let sheet: CSSStyleSheet | null = null;
function styleSheet(): CSSStyleSheet {
  if (!sheet) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLES);
  }
  return sheet;
}

const drawn = new Set<StepwrightScene>();

export class StepwrightScene extends Base {
  static readonly observedAttributes: readonly string[] = ATTRIBUTES;
  private player: Player | null = null;
  private markers: TaskMarkers | null = null;
  private picture: Picture | null = null;
  private strip: Strip | null = null;
  private near = false;
  private seen = false;
  private said = false;
  private marked = false;
  private opened = 0;
  private watchers: { disconnect(): void }[] = [];
  private readonly view = el("div", { class: "view", part: "view" });
  private readonly bar = el("div", { class: "bar", part: "bar", hidden: true });
  /** Wider than a narrow page: keys scroll it. */
  private readonly panelBox = el("div", {
    class: "panels",
    part: "panels",
    role: "group",
    "aria-label": "Panels",
    tabindex: "0",
    hidden: true,
  });
  private readonly message = el("p", { class: "say", role: "alert", hidden: true });
  private readonly note = el("p", { class: "note", hidden: true });
  private readonly wait = el("span", { class: "wait" }, "Loading captures");
  private readonly live = el("div", { class: "hidden", "aria-live": "polite" });
  private readonly clock = el("div", { class: "clock", "aria-hidden": "true" });
  private readonly playButton = el("button", { class: "tool primary", type: "button" });
  private readonly undoButton = el(
    "button",
    { class: "tool", type: "button", "aria-label": "Undo", disabled: true },
    icon("undo"),
  );

  // ---- attributes and properties ---------------------------------------------------------------------------------

  get src(): string {
    return this.getAttribute("src") ?? "";
  }
  set src(value: string) {
    this.setAttribute("src", value);
  }
  /** The scene as it is now, the user's changes included. */
  get scene(): Scene | null {
    return this.player?.scene ?? null;
  }
  /** @throws SceneError when it is no scene. */
  set scene(value: Scene | object | null) {
    if (value === null) this.removeAttribute("scene");
    else this.setAttribute("scene", JSON.stringify(parseScene(value)));
  }
  get panels(): string {
    return this.getAttribute("panels") ?? "";
  }
  set panels(value: string) {
    this.setAttribute("panels", value);
  }
  get theme(): string {
    return this.getAttribute("theme") ?? "";
  }
  set theme(value: string) {
    this.setAttribute("theme", value);
  }
  get controls(): boolean {
    return this.hasAttribute("controls");
  }
  set controls(value: boolean) {
    this.toggleAttribute("controls", value);
  }
  get autoplay(): boolean {
    return this.hasAttribute("autoplay");
  }
  set autoplay(value: boolean) {
    this.toggleAttribute("autoplay", value);
  }
  get loop(): boolean {
    return this.hasAttribute("loop");
  }
  set loop(value: boolean) {
    this.toggleAttribute("loop", value);
  }
  get locked(): boolean {
    return this.hasAttribute("locked");
  }
  set locked(value: boolean) {
    this.toggleAttribute("locked", value);
  }
  get paused(): boolean {
    return !this.player?.playing;
  }
  /** Seconds. */
  get duration(): number {
    return this.player?.duration ?? 0;
  }
  /** Playing time, seconds; setting it seeks. */
  get currentTime(): number {
    return this.player?.time ?? 0;
  }
  set currentTime(value: number) {
    this.player?.seek(value);
  }
  /** Playing speed; 1 is as captured. */
  get playbackRate(): number {
    return this.player?.speed ?? 1;
  }
  set playbackRate(value: number) {
    if (this.player && value > 0) this.player.speed = value;
  }
  /** The plan that is shown; null before the first. */
  get plan(): Plan | null {
    return this.player?.plan ?? null;
  }
  /** How good the motion is; null until all of it has arrived. */
  get quality(): QualityFigures | null {
    return this.player?.quality ?? null;
  }
  /** Whether a worker plans, or the page itself where none can start. */
  get plannedIn(): "worker" | "page" {
    return this.player?.where ?? "worker";
  }

  play(): void {
    this.player?.play();
  }
  pause(): void {
    this.player?.pause();
  }
  seek(seconds: number): void {
    this.player?.seek(seconds);
  }
  undo(): void {
    this.player?.undo();
  }
  /** A change of the scene, planned at once. @throws SceneError when the outcome is no scene. */
  edit(change: (scene: Scene) => Scene): void {
    this.player?.edit(change);
  }
  /** Back to the scene that the attributes name. */
  reset(): void {
    void this.open();
  }

  // ---- life ------------------------------------------------------------------------------------------------------

  connectedCallback(): void {
    if (!this.shadowRoot) {
      this.keepEarly();
      this.build(this.attachShadow({ mode: "open" }));
    }
    if (this.player) return;
    this.applyTheme();
    void this.open();
    const near = new IntersectionObserver(
      ([e]) => {
        this.near = e.isIntersecting;
        this.refresh();
      },
      { rootMargin: NEAR },
    );
    const seen = new IntersectionObserver(([e]) => {
      this.seen = e.isIntersecting;
      this.refresh();
    });
    near.observe(this);
    seen.observe(this);
    const size = new ResizeObserver(() => this.resize());
    size.observe(this.view);
    size.observe(this.bar);
    const hidden = () => this.refresh();
    document.addEventListener("visibilitychange", hidden);
    // Printers see no canvas: a still stands in its place.
    const printing = () => this.putStill();
    const printed = () => this.view.querySelector("img.still")?.remove();
    window.addEventListener("beforeprint", printing);
    window.addEventListener("afterprint", printed);
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    const themed = () => this.applyTheme();
    scheme.addEventListener("change", themed);
    this.watchers = [
      near,
      seen,
      size,
      {
        disconnect: () => {
          document.removeEventListener("visibilitychange", hidden);
          window.removeEventListener("beforeprint", printing);
          window.removeEventListener("afterprint", printed);
          scheme.removeEventListener("change", themed);
        },
      },
    ];
  }

  disconnectedCallback(): void {
    // An element that is only moved is connected again at once.
    queueMicrotask(() => {
      if (this.isConnected) return;
      for (const w of this.watchers) w.disconnect();
      this.watchers = [];
      this.setPicture(null);
      this.player?.dispose();
      this.player = null;
      this.markers?.overlay.remove();
      this.markers = null;
      this.opened++;
    });
  }

  attributeChangedCallback(
    name: (typeof ATTRIBUTES)[number],
    before: string | null,
    now: string | null,
  ): void {
    if (!this.shadowRoot || before === now) return;
    if (name === "src" || name === "scene") void this.open();
    else if (name === "theme") this.applyTheme();
    else this.applySettings();
  }

  /** Properties set before the element was defined hide those of the class: they are set again. */
  private keepEarly(): void {
    for (const name of [...ATTRIBUTES, "playbackRate"] as const) {
      if (!Object.hasOwn(this, name)) continue;
      const value: unknown = Reflect.get(this, name);
      Reflect.deleteProperty(this, name);
      Reflect.set(this, name, value);
    }
  }

  private build(root: ShadowRoot): void {
    root.adoptedStyleSheets = [styleSheet()];
    this.strip = new Strip(el("div"), (time) => this.player?.seek(time));
    this.playButton.addEventListener("click", () =>
      this.player?.playing ? this.player.pause() : this.player?.play(),
    );
    this.undoButton.addEventListener("click", () => this.player?.undo());
    this.bar.append(this.playButton, this.strip.element, this.clock, this.undoButton);
    const { editor } = places();
    if (editor !== null) {
      const open = el("a", { class: "tool", href: editor, target: "_blank", rel: "noopener" }, icon("steps"));
      open.append(el("span", {}, "Open"));
      open.setAttribute("aria-label", "Open in the editor");
      // The address carries the scene as it is when the link is about to be followed.
      for (const event of ["pointerdown", "pointerenter", "focus"])
        open.addEventListener(event, () => void this.addressEditor(open, editor));
      this.bar.append(open);
    }
    this.view.append(this.message, this.note, this.wait);
    root.append(this.view, this.panelBox, this.bar, this.live);
    this.showPlaying(false);
    this.showTime();
  }

  private async addressEditor(link: HTMLAnchorElement, editor: string): Promise<void> {
    if (!this.player) return;
    const { sceneToHash } = await import("../editor/session/share.ts");
    link.href = `${editor}${await sceneToHash(this.player.scene, "Shared scene")}`;
  }

  /** The scene that the attributes name: `scene`, else the document at `src`, else a room of our own. */
  private async open(): Promise<void> {
    const ticket = ++this.opened;
    let scene: Scene;
    try {
      const text = this.getAttribute("scene");
      if (text !== null) scene = readScene(text, "scene");
      else if (this.src) {
        const address = new URL(this.src, document.baseURI).href;
        const answer = await fetch(address);
        if (!answer.ok) throw new Error(`${this.src}: the scene could not be loaded (${answer.status}).`);
        scene = readScene(await answer.text(), this.src);
      } else scene = defaultScene();
    } catch (error) {
      if (ticket !== this.opened) return;
      const text = error instanceof Error ? error.message : String(error);
      this.fail(error instanceof TypeError ? `${this.src}: the scene could not be loaded.` : text);
      return;
    }
    if (ticket !== this.opened || !this.isConnected) return;
    this.message.hidden = true;
    if (this.player) this.player.load(scene);
    else this.start(scene);
  }

  private start(scene: Scene): void {
    this.player = new Player(scene, {
      planned: (plan) => {
        this.wait.hidden = true;
        this.strip?.setPlan(plan);
        this.showTime();
        this.drawPanels();
        this.tell("planned", { plan });
        this.tellReady();
      },
      solved: (quality) => {
        this.drawPanels();
        if (this.player && !this.player.dragging)
          this.live.textContent = `${this.player.plan?.steps.length ?? 0} footsteps planned.`;
        this.tell("solved", { quality });
      },
      time: (time) => {
        this.showTime();
        this.tell("timeupdate", { time, duration: this.duration });
      },
      playing: (playing, ended) => {
        this.showPlaying(playing);
        this.tell(playing ? "play" : "pause", null);
        if (ended) this.tell("ended", null);
      },
      changed: (changed) => {
        this.undoButton.disabled = !this.player?.canUndo;
        this.markers?.draw();
        this.tell("change", { scene: changed });
      },
      failed: (message) => this.fail(message),
    });
    this.markers = new TaskMarkers(this.player, (m) => this.fail(m));
    this.view.append(this.markers.overlay);
    this.applySettings();
    this.refresh();
  }

  private applySettings(): void {
    if (!this.player) return;
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.player.autoplay = this.autoplay && !calm;
    this.player.loop = this.loop;
    this.bar.hidden = !this.controls;
    if (this.markers) this.markers.overlay.hidden = this.locked;
    this.undoButton.hidden = this.locked;
    this.drawPanels();
  }

  private applyTheme(): void {
    const dark =
      this.theme === "dark" || (this.theme !== "light" && matchMedia("(prefers-color-scheme: dark)").matches);
    this.dataset.theme = dark ? "dark" : "light";
    this.picture?.setTheme(dark ? "dark" : "light");
  }

  // ---- drawing ---------------------------------------------------------------------------------------------------

  /** Gives the element its picture when it comes near, and lets time pass while it is seen. */
  private refresh(): void {
    if (!this.player) return;
    if (this.near && !this.picture) {
      if (drawn.size >= MOST_PICTURES) for (const other of drawn) if (!other.near) other.setPicture(null);
      const picture = drawOn(this.view, this.dataset.theme === "dark" ? "dark" : "light", () => {
        if (!this.marked) performance.mark(FIRST_RENDER);
        this.marked = true;
        this.markers?.draw();
        this.tellReady();
      });
      this.setPicture(picture);
    }
    this.player.setPaused(!this.seen || document.hidden);
  }

  private setPicture(picture: Picture | null): void {
    this.picture?.dispose();
    this.picture = picture;
    if (picture) drawn.add(this);
    else drawn.delete(this);
    this.resize();
    this.markers?.attach(picture?.view ?? null);
    this.player?.attach(picture?.view ?? null);
    this.note.textContent = picture?.note ?? "";
    this.note.hidden = !picture?.note;
  }

  private putStill(): void {
    const still = this.picture?.view.still?.();
    if (still === undefined) return;
    this.view.querySelector("img.still")?.remove();
    this.view.append(el("img", { class: "still", alt: "", src: still }));
  }

  private resize(): void {
    const box = this.view.getBoundingClientRect();
    if (box.width > 0) this.picture?.resize(box.width, box.height);
    if (this.strip) this.strip.resize(Math.floor(this.strip.element.clientWidth));
  }

  private drawPanels(): void {
    const names = this.panels.split(/\s+/).filter(Boolean);
    const player = this.player;
    this.panelBox.hidden = names.length === 0 || !player?.plan;
    if (names.length === 0 || !player?.plan) return;
    import("./panels.ts").then(
      ({ drawPanels }) => {
        if (player === this.player && player.plan)
          drawPanels(this.panelBox, names, player.plan, player.quality, player.time);
      },
      (error: unknown) => this.fail(error instanceof Error ? error.message : String(error)),
    );
  }

  private showPlaying(playing: boolean): void {
    this.playButton.replaceChildren(icon(playing ? "pause" : "play"));
    this.playButton.setAttribute("aria-label", playing ? "Pause" : "Play");
  }

  private showTime(): void {
    const text = (t: number) => t.toFixed(2).padStart(5, "0");
    this.clock.replaceChildren(text(this.currentTime), el("span", {}, ` / ${text(this.duration)}`));
    this.strip?.setTime(this.currentTime);
  }

  // ---- events ----------------------------------------------------------------------------------------------------

  private tellReady(): void {
    if (this.said || !this.picture || !this.player?.plan) return;
    this.said = true;
    this.tell("ready", null);
  }

  private tell<K extends keyof SceneEventDetails>(name: K, detail: SceneEventDetails[K]): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  /** Shows a sentence that says what is wrong, and tells of it. */
  fail(text: string): void {
    this.message.textContent = text;
    this.message.hidden = false;
    this.wait.hidden = true;
    this.tell("error", { message: text });
  }

  /** The scene document as text, the user's changes included; empty before there is one. */
  toJSONText(): string {
    return this.player ? serializeScene(this.player.scene) : "";
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "stepwright-scene": StepwrightScene;
  }
}
