/** The clip: what was found in the file, its joints, tasks, steps, clean-up, and whether it is in the library. */
import { html, nothing, type TemplateResult } from "lit";
import { TASK_CATEGORIES, type TaskCategory } from "../../core/scene/task-types.ts";
import { JOINT_NAMES } from "../../core/skeleton/joints.ts";
import { PHASES, type Phase, STEP_CATEGORIES, type StepCategory } from "../../core/steps/types.ts";
import { CATEGORY_WORDS } from "../../view/tokens.ts";
import { download } from "../formats/download.ts";
import type { Capture } from "./capture.ts";
import type { CaptureSession } from "./session.ts";
import { taskHere } from "./task-here.ts";

const metres = (v: number): string => `${v.toFixed(2).replace("-", "−")} m`;
const word = (s: string): string => s[0].toUpperCase() + s.slice(1);

export function clipTab(s: CaptureSession): TemplateResult {
  const c = s.current;
  if (!c) return html`<section class="section"><p class="note">Open a BVH file first.</p></section>`;
  return html`${captureList(s)}${facts(c)}${jointsSection(s, c)}${cleanSection(s, c)}${tasksSection(s, c)}${stepsSection(s, c)}${librarySection(s, c)}${stonesSection(s, c)}`;
}

function captureList(s: CaptureSession): TemplateResult | typeof nothing {
  if (s.captures.length < 2) return nothing;
  return html`<section class="section"><header><h3>Captures</h3><span>${s.captures.length}</span></header><div class="list">${s.captures.map((c) => html`<button aria-current=${c === s.current} @click=${() => s.show(c)}>${c.key}<span class="quiet">${c.report.seconds.toFixed(1)} s</span></button>`)}</div></section>`;
}

function facts(c: Capture): TemplateResult {
  const r = c.report;
  const row = (name: string, value: string) =>
    html`<div class="row"><span>${name}</span><span>${value}</span></div>`;
  return html`<section class="section"><header><h3>${c.name}</h3><span>${r.frames.toLocaleString("en")} frames, ${r.rate} Hz</span></header>
    ${row("Floor", `${metres(r.floor)} in the file`)}${row("Scale", `1 unit is ${Number(r.scale.toPrecision(4))} m, ${r.up} up`)}${row("Leg", metres(r.legLength))}
    ${r.warnings.map((w) => html`<p class="note">${w}</p>`)}
  </section>`;
}

/** Joints as they were told by name; those that were not can be named here. */
function jointsSection(s: CaptureSession, c: Capture): TemplateResult {
  const { mapped, missing } = c.report;
  const change = (ours: string, theirs: string): void =>
    void s.remap(c, { ...mapped, ...(c.mapping ?? {}), [ours]: theirs });
  const field = (ours: string) =>
    html`<label class="row"><span>${ours}</span><select @change=${(ev: Event) => change(ours, (ev.target as HTMLSelectElement).value)}><option value="">none</option>${c.joints.map((j) => html`<option value=${j} ?selected=${mapped[ours] === j}>${j}</option>`)}</select></label>`;
  return html`<section class="section"><header><h3>Joints</h3><span>${missing.length === 0 ? "all recognised" : `${missing.length} not recognised`}</span></header>
    ${missing.map(field)}
    <details><summary>Recognised, ${Object.keys(mapped).length}</summary>${JOINT_NAMES.filter((j) => !missing.includes(j)).map(field)}</details>
  </section>`;
}

function cleanSection(s: CaptureSession, c: Capture): TemplateResult {
  const m = c.cleaned;
  return html`<section class="section"><header><h3>Clean-up</h3><span>${m ? `skate ${m.skate[0].toFixed(1)} mm, now ${m.skate[1].toFixed(1)} mm` : "footskate"}</span></header>
    <div class="actions"><button class="outline" @click=${() => void s.clean()}>Clean</button>
    ${m ? html`<button class="plain" @click=${() => download(`${c.key}-clean.bvh`, m.text, "text/plain")}>Export BVH</button>` : nothing}</div>
    ${m ? html`<div class="segments" role="group" aria-label="Feet shown over time">${(["none", "before", "after"] as const).map((v) => html`<button aria-pressed=${s.feetShown === v} @click=${() => s.showFeet(v)}>${v === "none" ? "No overlay" : word(v)}</button>`)}</div>` : nothing}
  </section>`;
}

function tasksSection(s: CaptureSession, c: Capture): TemplateResult {
  return html`<section class="section"><header><h3>Tasks</h3><span>marked at the cursor</span></header>
    <div class="actions wrap">${TASK_CATEGORIES.map((k: TaskCategory) => html`<button class="outline" @click=${() => s.setTasks(c, [...c.tasks, taskHere(c, k)])}>${word(k)}</button>`)}</div>
    ${c.tasks.map(
      (
        t,
        i,
      ) => html`<div class="row"><button class="plain" @click=${() => s.moveTo(t.contact * c.clip.rate)}>${word(t.category)}, ${t.contact.toFixed(2)} s</button><span class="fields">
        <select aria-label="Effort" @change=${(ev: Event) =>
          s.setTasks(
            c,
            c.tasks.map((x, k) =>
              k === i ? { ...x, effort: Number((ev.target as HTMLSelectElement).value) as 0 | 1 } : x,
            ),
          )}><option value="0" ?selected=${t.effort === 0}>low effort</option><option value="1" ?selected=${t.effort === 1}>high effort</option></select>
        <button class="plain danger" @click=${() =>
          s.setTasks(
            c,
            c.tasks.filter((_, k) => k !== i),
          )}>Delete</button></span></div>
        <p class="note">at ${metres(t.position[0])}, ${metres(t.position[1])}, ${metres(t.position[2])}</p>`,
    )}
  </section>`;
}

function stepsSection(s: CaptureSession, c: Capture): TemplateResult {
  const steps = c.steps ?? [];
  const choose = <T extends string>(
    i: number,
    key: "category" | "phase",
    values: readonly T[],
    words: (v: T) => string,
  ) =>
    html`<select aria-label=${key} @change=${(ev: Event) => s.editStep(c, i, { [key]: (ev.target as HTMLSelectElement).value as StepCategory & Phase })}>${values.map((v) => html`<option value=${v} ?selected=${steps[i][key] === (v as string)}>${words(v)}</option>`)}</select>`;
  const edge = (i: number, key: "start" | "end", label: string) =>
    html`<input type="number" aria-label=${label} min="0" max=${c.edits.frames - 1} .value=${String(steps[i][key])} @change=${(ev: Event) => s.editStep(c, i, { [key]: Number((ev.target as HTMLInputElement).value) })} />`;
  return html`<section class="section"><header><h3>Steps</h3><span>${steps.length}${c.stepsEdited ? ", corrected" : ""}</span></header>
    <div class="steps">${steps.map(
      (x, i) =>
        html`<div><button class="plain" @click=${() => s.moveTo(x.start)}>${x.foot === "left" ? "L" : "R"}</button>${edge(i, "start", "Lift, frame")}${edge(i, "end", "Land, frame")}${choose(i, "category", STEP_CATEGORIES, (v) => CATEGORY_WORDS[v])}${choose(i, "phase", PHASES, word)}</div>`,
    )}</div>
    <div class="actions"><button class="plain" @click=${() => void s.findSteps(c)}>Find again</button></div>
  </section>`;
}

function librarySection(s: CaptureSession, c: Capture): TemplateResult {
  return html`<section class="section"><header><h3>Library</h3><span>${c.inLibrary ? "in your library" : "not in it"}</span></header>
    <p class="note">Steps and tasks of this capture become templates beside the shipped ones. They stay in this browser. Left out, a capture can be laid beside a plan of its own tasks.</p>
    <div class="actions"><button class="outline" @click=${() => void s.setInLibrary(c, !c.inLibrary)}>${c.inLibrary ? "Leave the library" : "Join the library"}</button><button class="outline" @click=${() => s.compare(c)}>Compare with the plan</button><button class="plain danger" @click=${() => void s.close(c)}>Close the capture</button></div>
  </section>`;
}

/** Steps on stones are blended of clips that go on evenly: a capture joins those that ship, or takes the place of one. */
function stonesSection(s: CaptureSession, c: Capture): TemplateResult {
  const shipped = s.shippedCycles();
  const value = (ev: Event): string =>
    (
      (ev.currentTarget as HTMLElement)
        .closest("section")
        ?.querySelector("select") as HTMLSelectElement | null
    )?.value || c.key;
  return html`<section class="section" data-part="stones"><header><h3>Stepping stones</h3><span>${c.cycle ? (shipped.includes(c.cycle) ? `instead of ${c.cycle}` : "beside ours") : "not used"}</span></header>
    <p class="note">An even walk, run, side step or turn of six steps or more becomes one of the clips that steps on stones are blended of.</p>
    <label class="row"><span>In the place of</span><select><option value="">none: beside ours</option>${shipped.map((n) => html`<option value=${n} ?selected=${c.cycle === n}>${n}</option>`)}</select></label>
    <div class="actions"><button class="outline" @click=${(ev: Event) => s.blend(c, value(ev))}>Use for stepping stones</button>${c.cycle ? html`<button class="plain" @click=${() => s.unblend(c)}>Leave them</button>` : nothing}</div>
  </section>`;
}
