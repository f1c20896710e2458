/**
 * The captures that a person has brought: opening, labelling, training, cleaning, joining the library. Page parts draw
 * from it and call it; the worker does the work.
 */

import type { SidecarTask } from "../../core/capture/sidecar.ts";
import { SEGMENT, type Segment } from "../../core/contacts/active-learning.ts";
import { LabelTrack } from "../../core/contacts/label-track.ts";
import type { PlannerResponse } from "../../workers/protocol.ts";
import { compareSession } from "../compare/session.ts";
import type { Editor } from "../editor.ts";
import { download } from "../formats/download.ts";
import type { Capture, Stretch } from "./capture.ts";
import { CancelledError, ContactsClient, type Progress } from "./client.ts";
import { correctStep, type StepChange } from "./correct-step.ts";
import { DeskClock } from "./desk-clock.ts";
import type { DeskTab } from "./desk-panel.ts";
import { labelsOfCsv } from "./label-files.ts";
import { fetchCapture, type PublicCapture, publicCaptures } from "./public-list.ts";
import { forgetCapture, keepCapture, keepLibrary, loadCaptures, loadLibrary } from "./storage.ts";

/** Milliseconds after the last edit at which labels are kept. */
const KEEP_AFTER = 400;

export class CaptureSession {
  captures: Capture[] = [];
  current: Capture | null = null;
  stretch: Stretch = { first: 0, last: 0 };
  progress: (Progress & { label: string }) | null = null;
  examples = 0;
  /** Share of labels that the oracle is sure of after so many segments were confirmed. */
  sureness: { segments: number; sure: number }[] = [];
  segments: (Segment & { key: string })[] = [];
  tab: DeskTab = "labels";
  /** Feet laid over each other in time: as captured, as cleaned, or not. */
  feetShown: "none" | "before" | "after" = "none";
  publicList: PublicCapture[] = [];
  private readonly client: ContactsClient;
  private busy: number | null = null;
  private keepTimer = 0;
  /** The cycle that is told of when it is taken in. */
  private told: string | null = null;
  private readonly listeners = new Set<() => void>();
  readonly clock = new DeskClock({
    span: () => (this.deskOpen && this.current ? { ...this.stretch, rate: this.current.clip.rate } : null),
    cursor: () => this.current?.edits.cursor ?? 0,
    moveTo: (frame) => this.moveTo(frame),
    changed: () => this.changed(),
  });

  constructor(private readonly e: Editor) {
    e.plan.listen((m) => this.hearCycle(m));
    this.client = new ContactsClient(new URL("generated/oracle.bin", document.baseURI).href, {
      progress: (p) => {
        this.progress = { ...p, label: WORDS[p.doing] };
        this.changed();
      },
      ready: (examples) => {
        this.examples = examples;
        this.changed();
      },
      restarted: () => void this.reopen(),
      failed: (message) => this.e.fail(message),
    });
  }

  onChange(listener: () => void): void {
    this.listeners.add(listener);
  }

  changed(): void {
    for (const l of this.listeners) l();
  }

  // ---- opening -------------------------------------------------------------------------------------------------

  /** What was kept in this browser; quiet where there is nothing. */
  async restore(): Promise<void> {
    const kept = await loadCaptures();
    for (const k of kept) {
      const c = await this.read(k.key, k.name, k.file, k.mapping);
      if (!c) continue;
      if (k.labels.length === c.edits.frames) c.edits = new LabelTrack(k.labels, k.confirmed, k.touched);
      c.tasks = k.tasks;
      c.steps = k.steps;
      c.stepsEdited = k.steps !== null;
      c.inLibrary = k.inLibrary;
      if (k.cycle) this.blend(c, k.cycle, false);
    }
    if (this.captures.length > 0) {
      await this.train();
      if (!this.current) this.show(this.captures[0]);
    }
    const library = await loadLibrary();
    if (library) this.e.plan.useLibrary(library);
  }

  /** Opens BVH files one after the other; the last becomes the one at hand. */
  async open(files: readonly File[]): Promise<void> {
    let last: Capture | null = null;
    for (const file of files) {
      const key = this.freeKey(file.name.replace(/\.bvh$/i, ""));
      const c = await this.read(key, file.name, file, null);
      if (!c) continue;
      last = c;
      void this.keep(c);
    }
    if (!last) return;
    await this.train();
    this.show(last);
    this.e.tools.use("label");
  }

  private freeKey(name: string): string {
    let key = name;
    for (let k = 2; this.captures.some((c) => c.key === key); k++) key = `${name} (${k})`;
    return key;
  }

  private async read(
    key: string,
    name: string,
    file: Blob,
    mapping: Record<string, string> | null,
  ): Promise<Capture | null> {
    const m = await this.ask(() => this.client.ask({ type: "open", key, name, file, mapping }, "opened"));
    if (!m) return null;
    const before = this.captures.findIndex((c) => c.key === key);
    const c: Capture = {
      key,
      name,
      file,
      mapping,
      report: m.report,
      joints: m.joints,
      clip: m.clip,
      curves: m.curves,
      share: m.thought.share,
      edits: new LabelTrack(m.thought.labels),
      tasks: [],
      steps: null,
      stepsEdited: false,
      inLibrary: false,
      cycle: null,
      cleaned: null,
    };
    if (before >= 0) this.captures[before] = c;
    else this.captures.push(c);
    for (const w of m.report.warnings) this.e.say(`${name}: ${w}`, false);
    this.changed();
    return c;
  }

  /** Reads a capture again with another mapping of its joints. */
  async remap(c: Capture, mapping: Record<string, string>): Promise<void> {
    const again = await this.read(c.key, c.name, c.file, mapping);
    if (!again) return;
    again.edits = new LabelTrack(c.edits.labels, c.edits.confirmed, c.edits.touched);
    again.edits.fill(this.thoughtLabels(again));
    again.tasks = c.tasks;
    again.inLibrary = c.inLibrary;
    if (c.cycle) this.blend(again, c.cycle, false);
    this.show(again);
    void this.keep(again);
  }

  private thoughtLabels(c: Capture): Uint8Array {
    const out = new Uint8Array(c.edits.frames);
    for (let f = 0; f < out.length; f++)
      for (let b = 0; b < 4; b++) if (c.share[4 * f + b] >= 0.5) out[f] |= 1 << b;
    return out;
  }

  async close(c: Capture): Promise<void> {
    this.captures = this.captures.filter((x) => x !== c);
    this.client.close(c.key);
    if (c.cycle) this.unblend(c);
    await forgetCapture(c.key);
    if (this.current === c) {
      this.current = null;
      const next = this.captures[0];
      if (next) this.show(next);
    }
    this.changed();
  }

  /** The worker was replaced: everything is opened again, labels are the page's own. */
  private async reopen(): Promise<void> {
    this.e.say("Reading captures was restarted. Nothing was lost.", false);
    for (const c of this.captures)
      await this.ask(() =>
        this.client.ask(
          { type: "open", key: c.key, name: c.name, file: c.file, mapping: c.mapping },
          "opened",
        ),
      );
    await this.train();
  }

  // ---- asking --------------------------------------------------------------------------------------------------

  private async ask<T>(start: () => { id: number; answer: Promise<T> }): Promise<T | null> {
    const { id, answer } = start();
    this.busy = id;
    try {
      return await answer;
    } catch (error) {
      if (!(error instanceof CancelledError))
        this.e.fail(error instanceof Error ? error.message : String(error));
      return null;
    } finally {
      if (this.busy === id) {
        this.busy = null;
        this.progress = null;
      }
      this.changed();
    }
  }

  cancel(): void {
    if (this.busy !== null) this.client.cancel(this.busy);
  }

  // ---- time ----------------------------------------------------------------------------------------------------

  show(c: Capture, segment?: Stretch): void {
    this.current = c;
    const first = segment?.first ?? 0;
    this.stretch = segment ?? { first, last: Math.min(c.edits.frames, first + SEGMENT) };
    c.edits.moveTo(this.stretch.first);
    if (!c.steps) void this.findSteps(c);
    this.changed();
  }

  moveTo(frame: number): void {
    const c = this.current;
    if (!c) return;
    const f = Math.max(0, Math.min(c.edits.frames - 1, Math.round(frame)));
    // Outside of the stretch shown, the stretch goes along.
    if (f < this.stretch.first || f >= this.stretch.last) {
      const first = SEGMENT * Math.floor(f / SEGMENT);
      this.stretch = { first, last: Math.min(c.edits.frames, first + SEGMENT) };
    }
    c.edits.moveTo(f);
    this.changed();
  }

  get deskOpen(): boolean {
    return this.e.tools.current.id === "label";
  }

  // ---- labels --------------------------------------------------------------------------------------------------

  /** After an edit: drawn, and kept when the hands rest. */
  edited(): void {
    this.changed();
    const c = this.current;
    window.clearTimeout(this.keepTimer);
    if (c) this.keepTimer = window.setTimeout(() => void this.keep(c), KEEP_AFTER);
  }

  /** An edit by a button. */
  act(edit: () => unknown): void {
    edit();
    this.edited();
  }

  /** Takes back, or does again, one entry of the labels' history; what the oracle has learned goes with it. */
  step(way: "undo" | "redo"): void {
    const c = this.current;
    if (!c) return;
    const before = c.edits.confirmed;
    c.edits[way]();
    this.edited();
    if (!before.every((v, f) => v === c.edits.confirmed[f])) void this.train();
  }

  setTab(tab: DeskTab): void {
    this.tab = tab;
    this.changed();
  }

  showFeet(shown: CaptureSession["feetShown"]): void {
    this.feetShown = shown;
    this.changed();
  }

  /** Tasks of a capture; its steps and phases are found anew. */
  setTasks(c: Capture, tasks: SidecarTask[]): void {
    c.tasks = tasks;
    this.edited();
    void this.findSteps(c);
  }

  /** A step corrected by hand. Frames are held inside the clip and in order. */
  editStep(c: Capture, index: number, change: StepChange): void {
    const steps = correctStep(c.steps ?? [], index, change, c.edits.frames);
    if (!steps) return;
    c.steps = steps;
    c.stepsEdited = true;
    this.edited();
  }

  pickFiles(): void {
    this.e.files.pick();
  }

  /** The list of public captures; a sentence where it cannot be read. */
  async loadPublicList(): Promise<void> {
    if (this.publicList.length > 0) return;
    try {
      this.publicList = await publicCaptures();
    } catch (error) {
      this.e.fail(error instanceof Error ? error.message : String(error));
    }
    this.changed();
  }

  async fetchPublic(p: PublicCapture): Promise<void> {
    try {
      await this.open([await fetchCapture(p)]);
    } catch (error) {
      this.e.fail(error instanceof Error ? error.message : String(error));
    }
  }

  private async keep(c: Capture): Promise<void> {
    const { key, name, file, mapping, tasks, inLibrary, cycle } = c;
    const ok = await keepCapture({
      key,
      name,
      file,
      mapping,
      labels: c.edits.labels,
      confirmed: c.edits.confirmed,
      touched: c.edits.touched,
      tasks,
      steps: c.stepsEdited ? c.steps : null,
      inLibrary,
      cycle,
    });
    if (!ok) this.e.say("Labels cannot be kept in this browser. Export them.", false);
  }

  /** The stretch is as it should be: the oracle learns it, and the next stretch to label is shown. */
  async confirm(): Promise<void> {
    const c = this.current;
    if (!c) return;
    c.edits.confirm(this.stretch.first, this.stretch.last);
    this.edited();
    await this.train();
    this.next();
  }

  /** Shows the stretch that the oracle knows least and that nobody has confirmed. */
  next(): void {
    const found = this.openSegments()[0];
    const c = this.captures.find((x) => x.key === found?.key);
    if (c && found) this.show(c, { first: found.first, last: found.last });
    else this.e.announce("Every segment is labelled.");
  }

  /** Segments that are not confirmed, the most foreign first. */
  openSegments(): (Segment & { key: string })[] {
    return this.segments.filter((s) => {
      const c = this.captures.find((x) => x.key === s.key);
      return c?.edits.confirmed.subarray(s.first, s.last).includes(0) === true;
    });
  }

  skip(): void {
    const open = this.openSegments();
    const here = open.findIndex((s) => s.key === this.current?.key && s.first === this.stretch.first);
    const to = open[(here + 1) % Math.max(1, open.length)];
    const c = this.captures.find((x) => x.key === to?.key);
    if (c && to) this.show(c, { first: to.first, last: to.last });
  }

  async train(): Promise<void> {
    if (this.captures.length === 0) return;
    const lessons = this.captures.map((c) => ({
      key: c.key,
      labels: c.edits.labels.slice(),
      mask: c.edits.confirmed.slice(),
    }));
    const learned = new Map(lessons.map((l) => [l.key, l.mask.slice()]));
    const m = await this.ask(() => this.client.ask({ type: "train", lessons }, "trained"));
    if (!m) return;
    this.examples = m.examples;
    this.segments = m.segments.map((s) => ({ ...s, key: m.keys[s.motion] }));
    // What was undone is forgotten here too.
    const segments = this.segments.length - this.openSegments().length;
    this.sureness = [...this.sureness.filter((p) => p.segments < segments), { segments, sure: m.sure }];
    for (const t of m.thoughts) {
      const c = this.captures.find((x) => x.key === t.key);
      if (!c?.edits.fill(t.labels, learned.get(t.key))) continue;
      c.share = t.share;
      if (!c.stepsEdited) c.steps = null;
    }
    if (this.current && !this.current.steps) void this.findSteps(this.current);
    this.e.announce(
      `The oracle is sure of ${(100 * m.sure).toFixed(1)} percent of labels, from ${m.examples} examples.`,
    );
    this.changed();
  }

  // ---- files ---------------------------------------------------------------------------------------------------

  /** Labels from a CSV of the capture at hand. @throws Error that names the file. */
  async openCsv(file: File): Promise<void> {
    const c = this.current;
    if (!c) throw new Error(`${file.name}: open the capture that these labels are of first.`);
    const labels = labelsOfCsv(c, await file.text(), file.name);
    c.edits.replace(labels);
    this.edited();
    await this.train();
  }

  async saveModel(): Promise<void> {
    const m = await this.ask(() => this.client.ask({ type: "save" }, "saved"));
    if (m) download("oracle.bin", new Blob([m.bytes as Uint8Array<ArrayBuffer>]), "application/octet-stream");
  }

  async openModel(file: File): Promise<void> {
    this.client.useModel(new Uint8Array(await file.arrayBuffer()), file.name);
    await this.train();
  }

  // ---- clean, steps, library -----------------------------------------------------------------------------------

  async clean(): Promise<void> {
    const c = this.current;
    if (!c) return;
    const contacts = c.edits.labels.slice();
    const m = await this.ask(() => this.client.ask({ type: "clean", key: c.key, contacts }, "cleaned"));
    if (!m) return;
    c.cleaned = { text: m.text, clip: m.clip, report: m.report, skate: m.skate };
    this.feetShown = "after";
    this.e.announce(
      `Cleaned. Skate ${m.skate[0].toFixed(1)} millimetres before, ${m.skate[1].toFixed(1)} after.`,
    );
    this.changed();
  }

  async findSteps(c: Capture): Promise<void> {
    const contacts = c.edits.labels.slice();
    const m = await this.ask(() =>
      this.client.ask({ type: "steps", key: c.key, contacts, tasks: c.tasks }, "steps"),
    );
    if (!m) return;
    c.steps = m.steps;
    c.stepsEdited = false;
    this.changed();
  }

  /** Plans the capture's own tasks and lays the capture beside the plan. */
  compare(c: Capture): void {
    compareSession(this.e).capture(c);
  }

  /**
   * Steps on stones are blended of this capture too, from the labels as they are now.
   *
   * @param as the shipped clip that it replaces, or a name of its own to join. @param say whether it is told.
   */
  blend(c: Capture, as: string, say = true): void {
    if (c.cycle && c.cycle !== as) this.e.plan.planner.forgetCycle(c.cycle);
    for (const other of this.captures) if (other !== c && other.cycle === as) other.cycle = null;
    c.cycle = as;
    this.told = say ? as : this.told;
    this.e.plan.planner.addCycle(as, c.clip, c.edits.labels.slice());
    this.changed();
  }

  /** Names of the clips that ship, as far as a plan over stones has told them. */
  shippedCycles(): string[] {
    const own = new Set(this.captures.map((c) => c.key));
    return (this.e.store.getState().plan?.blend?.names ?? []).filter((n) => !own.has(n));
  }

  unblend(c: Capture): void {
    if (c.cycle) this.e.plan.planner.forgetCycle(c.cycle);
    c.cycle = null;
    void this.keep(c);
    this.e.plan.ask();
    this.changed();
  }

  private hearCycle(m: PlannerResponse): void {
    if (m.type !== "cycle" && m.type !== "cycle-failed") return;
    const c = this.captures.find((x) => x.cycle === m.name);
    if (m.type === "cycle-failed") {
      this.e.plan.planner.forgetCycle(m.name);
      if (c) c.cycle = null;
      this.e.fail(m.message);
    } else if (this.told === m.name)
      this.e.say(
        `${c?.name ?? m.name} ${m.replaces ? `replaces ${m.name}` : "joins the clips"} that steps on stones are blended of.`,
        false,
      );
    this.told = null;
    if (c) void this.keep(c);
    // The triangles of both feet are drawn anew with the plan.
    this.e.plan.ask();
    this.changed();
  }

  async setInLibrary(c: Capture, inLibrary: boolean): Promise<void> {
    c.inLibrary = inLibrary;
    void this.keep(c);
    const entries = this.captures
      .filter((x) => x.inLibrary)
      .map((x) => ({
        key: x.key,
        contacts: x.edits.labels.slice(),
        tasks: x.tasks,
        steps: x.stepsEdited ? x.steps : null,
      }));
    if (entries.length === 0) {
      await keepLibrary(null);
      this.e.plan.useLibrary(null);
      this.changed();
      return;
    }
    const m = await this.ask(() => this.client.ask({ type: "library", entries }, "library"));
    if (!m) return;
    await keepLibrary(m.bytes);
    this.e.plan.useLibrary(m.bytes);
    this.e.say(
      `${c.name} ${inLibrary ? "joined" : "left"} the library: ${m.templates} templates and ${m.walks} walks of your own.`,
      false,
    );
    this.changed();
  }
}

const WORDS = {
  reading: "Reading",
  importing: "Importing",
  contacts: "Finding contacts",
  cleaning: "Cleaning",
} as const;
