/** Files out and in, by the registered formats. */
import type { Editor } from "../editor.ts";
import { download } from "../formats/download.ts";
import type { ExportFormat, ImportFormat } from "../formats/format.ts";
import { carriesScene, LONGEST_LINK, sceneFromHash, sceneToHash } from "./share.ts";
import { keepVersion } from "./storage.ts";

export class Files {
  constructor(private readonly e: Editor) {
    window.addEventListener("dragover", (ev) => ev.preventDefault());
    window.addEventListener("hashchange", () => void this.openLink());
    window.addEventListener("drop", (ev) => {
      ev.preventDefault();
      const files = [...(ev.dataTransfer?.files ?? [])];
      if (files.length > 0) void this.open(files);
    });
  }

  /** "two-tables.bvh": the scene's name with a format's ending. */
  private named(ending: string): string {
    const stem = this.e.store
      .getState()
      .name.toLowerCase()
      .replace(/[^\p{L}\p{N}]+/gu, "-")
      .replace(/^-+|-+$/g, "");
    return `${stem === "" ? "scene" : stem}${ending}`;
  }

  /** Hands a file of a format to the visitor. */
  async save(format: ExportFormat): Promise<void> {
    this.e.setMenu(null);
    const blocked = format.blocked?.(this.e) ?? null;
    if (blocked !== null) {
      this.e.fail(blocked);
      return;
    }
    try {
      const content = await format.make(this.e);
      if (content !== null) download(this.named(format.file), content, format.type);
    } catch (error) {
      this.e.fail(`${format.file}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }

  /** Puts a link that carries the scene on the clipboard, and into the address bar. */
  async share(): Promise<void> {
    const { scene, name } = this.e.store.getState();
    const hash = await sceneToHash(scene, name);
    if (hash.length > LONGEST_LINK) {
      this.e.fail(
        `This scene is too large for a link (${Math.round(hash.length / 1000)} kB). Export it as a file.`,
      );
      return;
    }
    history.replaceState(null, "", hash);
    try {
      await navigator.clipboard.writeText(location.href);
      this.e.say("Link copied. It holds the whole scene.", false);
    } catch {
      // Clipboards are closed to pages that are not secure or not at the front: the address bar has the link all the same.
      this.e.say("The link is in the address bar. It holds the whole scene.", false);
    }
  }

  /** Opens the scene of the address, when it carries one; what was being edited is kept as a version. */
  async openLink(): Promise<void> {
    if (!carriesScene(location.hash)) return;
    const { hash } = location;
    // A reload goes on with what is edited then.
    history.replaceState(null, "", location.pathname + location.search);
    try {
      const shared = await sceneFromHash(hash);
      const { scene, name } = this.e.store.getState();
      if (JSON.stringify(shared.scene) === JSON.stringify(scene)) return;
      await keepVersion(`${name}, before a link`, scene, Date.now());
      this.e.scene.replace(shared.scene, shared.name);
    } catch (error) {
      this.e.fail(error instanceof Error ? error.message : String(error));
    }
  }

  /** Asks the visitor for files of any registered kind. */
  pick(): void {
    const input = document.createElement("input");
    input.type = "file";
    input.multiple = true;
    input.accept = this.e.registry.imports.flatMap((f) => f.endings).join(",");
    input.onchange = () => void this.open([...(input.files ?? [])]);
    input.click();
  }

  /** Opens files, each kind together. */
  async open(files: readonly File[]): Promise<void> {
    const groups = new Map<ImportFormat, File[]>();
    for (const file of files) {
      const name = file.name.toLowerCase();
      let format: ImportFormat | undefined;
      for (const f of this.e.registry.imports)
        if (!format && f.endings.some((x) => name.endsWith(x)) && (await (f.accepts?.(file) ?? true)))
          format = f;
      if (!format) {
        const known = this.e.registry.imports.flatMap((f) => f.endings).join(", ");
        this.e.fail(`${file.name}: files of this kind are not read. Known: ${known}.`);
        continue;
      }
      groups.set(format, [...(groups.get(format) ?? []), file]);
    }
    for (const [format, mine] of groups) {
      try {
        await format.open(this.e, mine);
      } catch (error) {
        this.e.fail(error instanceof Error ? error.message : String(error));
      }
    }
  }
}
