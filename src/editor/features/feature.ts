/** What a feature adds to the editor. `features/all.ts` lists them; the editor knows nothing else of them. */
import type { Editor } from "../editor.ts";
import type { ExportFormat, ImportFormat } from "../formats/format.ts";
import type { KeyBinding } from "../keys.ts";
import type { Lane } from "../lanes/lane.ts";
import type { ViewportLayer } from "../layers/layer.ts";
import type { MenuEntry } from "../menus.ts";
import type { PanelTab } from "../panels/panel-tab.ts";
import type { ThingKind } from "../things/thing.ts";
import type { Tool } from "../tools/tool.ts";

export interface Feature {
  id: string;
  tools?: readonly Tool[];
  /** Kinds of things that can be selected, moved and removed. */
  things?: readonly ThingKind[];
  tabs?: readonly PanelTab[];
  lanes?: readonly Lane[];
  /** Made once, when the stage stands. */
  layers?: readonly ((e: Editor) => ViewportLayer)[];
  imports?: readonly ImportFormat[];
  exports?: readonly ExportFormat[];
  keys?: readonly KeyBinding[];
  menu?: readonly MenuEntry[];
  /** Once, after everything is in place: subscriptions, worker clients. */
  start?(e: Editor): void;
}

type Ordered = { order: number };
const inOrder = <T extends Ordered>(list: T[]): readonly T[] => list.sort((a, b) => a.order - b.order);

/** Everything that the features add, each kind in its order. */
export class Registry {
  readonly tools: readonly Tool[];
  readonly things: readonly ThingKind[];
  readonly tabs: readonly PanelTab[];
  readonly lanes: readonly Lane[];
  readonly layers: readonly ((e: Editor) => ViewportLayer)[];
  readonly imports: readonly ImportFormat[];
  readonly exports: readonly ExportFormat[];
  readonly keys: readonly KeyBinding[];
  readonly menu: readonly MenuEntry[];

  constructor(readonly features: readonly Feature[]) {
    this.tools = inOrder(features.flatMap((f) => f.tools ?? []));
    this.things = inOrder(features.flatMap((f) => f.things ?? []));
    this.tabs = inOrder(features.flatMap((f) => f.tabs ?? []));
    this.lanes = inOrder(features.flatMap((f) => f.lanes ?? []));
    this.layers = features.flatMap((f) => f.layers ?? []);
    this.imports = features.flatMap((f) => f.imports ?? []);
    this.exports = inOrder(features.flatMap((f) => f.exports ?? []));
    this.keys = features.flatMap((f) => f.keys ?? []);
    this.menu = inOrder(features.flatMap((f) => f.menu ?? []));
  }

  thing(kind: string): ThingKind | undefined {
    return this.things.find((t) => t.kind === kind);
  }
}
