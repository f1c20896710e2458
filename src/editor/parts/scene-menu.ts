/** The menu under the scene's name: its name, versions kept, examples with pictures, a new room, a file. */
import { html, nothing, type TemplateResult } from "lit";
import type { Scene } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { EXAMPLES } from "../examples.ts";
import { dropVersion, keepVersion, listVersions, type Version } from "../session/storage.ts";
import { menuRows } from "./menu-rows.ts";
import { thumbnail } from "./thumbnail.ts";

/** Read when the menu opens, let go when it closes: forty scenes would stay otherwise. */
let versions: Version[] = [];
let pictures: { name: string; scene: Scene }[] | null = null;

/** Opens the menu with what is kept now. */
export async function openSceneMenu(e: Editor): Promise<void> {
  e.setMenu("scenes");
  if (e.store.getState().menu !== "scenes") return;
  const forget = e.store.subscribe(({ menu }) => {
    if (menu === "scenes") return;
    versions = [];
    forget();
  });
  const kept = await listVersions();
  if (e.store.getState().menu !== "scenes") return;
  versions = kept;
  e.redraw();
}

/** Keeps the scene as a version under its present name. */
export async function keepNow(e: Editor): Promise<void> {
  const { scene, name } = e.store.getState();
  const ok = await keepVersion(name, scene, Date.now());
  versions = await listVersions();
  if (ok) e.announce(`Version of ${name} kept.`);
  else e.fail("Versions are not kept: this browser's storage is closed or full.");
  e.redraw();
}

const when = (at: number): string =>
  new Date(at).toLocaleString(undefined, {
    day: "numeric",
    month: "short",
    hour: "2-digit",
    minute: "2-digit",
  });

export function sceneMenu(e: Editor): TemplateResult {
  const s = e.store.getState();
  pictures ??= EXAMPLES.map((x) => ({ name: x.name, scene: x.scene() }));
  return html`<div class="menu scenes" role="dialog" aria-label="Scenes">
    <label class="row"><span>Name</span><span class="field"><input aria-label="Scene name" maxlength="80" .value=${s.name} @change=${(ev: Event) => e.scene.rename((ev.target as HTMLInputElement).value)} /></span></label>
    <h3>Versions</h3>
    ${
      versions.length === 0
        ? html`<p class="note">Changes are kept as you go. Keep a version to come back to it.</p>`
        : html`<div class="versions">${versions.map(
            (v) => html`<div>
              <button @click=${() => e.scene.replace(v.scene, v.name)}>${thumbnail(v.scene)}<span>${v.name}<small>${when(v.at)}</small></span></button>
              <button class="icon" aria-label="Remove the version of ${when(v.at)}" @click=${() =>
                void dropVersion(v.key).then(async () => {
                  versions = await listVersions();
                  e.redraw();
                })}>×</button>
            </div>`,
          )}</div>`
    }
    <button class="button" @click=${() => void keepNow(e)}>Keep a version</button>
    <h3>Examples</h3>
    <div class="examples">${pictures.map((x) => html`<button @click=${() => e.scene.replace(x.scene, x.name)}>${thumbnail(x.scene)}<span>${x.name}</span></button>`)}</div>
    ${menuRows(
      e.registry.menu.filter((m) => m.menu === "scenes" && m.shown?.(e) !== false),
      (m) => m.run(e),
    )}
    ${s.saved === "off" ? html`<p class="note">Not kept: this browser's storage is closed. Export the scene to keep it.</p>` : nothing}
  </div>`;
}
