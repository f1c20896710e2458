/** Files out and in, by the registered formats. */
import type { Editor } from "../editor.ts";
import { download } from "../formats/download.ts";
import type { ExportFormat, ImportFormat } from "../formats/format.ts";

export class Files {
  constructor(private readonly e: Editor) {
    window.addEventListener("dragover", (ev) => ev.preventDefault());
    window.addEventListener("drop", (ev) => {
      ev.preventDefault();
      const files = [...(ev.dataTransfer?.files ?? [])];
      if (files.length > 0) void this.open(files);
    });
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
      download(format.file, await format.make(this.e), format.type);
    } catch (error) {
      this.e.fail(`${format.file}: ${error instanceof Error ? error.message : String(error)}`);
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
