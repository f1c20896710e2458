/** The fields of a scene's things as the schema has them: what an inspector needs to show and change each, without knowing which there are. */
import * as v from "valibot";
import { type FieldAbout, THING_SCHEMAS } from "./schema.ts";

export type ThingName = keyof typeof THING_SCHEMAS;
type FieldKind = "number" | "numbers" | "choice" | "switch";

/** One field: its key in the document, its name and unit, and what values it takes. */
export interface Field {
  key: string;
  kind: FieldKind;
  label: string;
  /** "°" is shown for radians. */
  unit: NonNullable<FieldAbout["unit"]> | "";
  /** Names of the numbers of `numbers`, else empty. */
  axes: readonly string[];
  /** Least and most of a number, in the document's unit. */
  range: readonly [number, number];
  /** Values of a choice in their order, with their words. */
  options: readonly { value: string | number; word: string }[];
  /** Whether null leaves it to the planner. */
  nullable: boolean;
  /** Kinds or categories of things that it is for; null: all. */
  only: readonly string[] | null;
  /** Least and most of a slider; null: a field. */
  slider: readonly [number, number] | null;
}

interface SchemaNode {
  type: string;
  wrapped?: SchemaNode;
  options?: readonly (string | number)[];
  pipe?: readonly { type: string; requirement?: unknown }[];
}

const KINDS: Readonly<Record<string, FieldKind>> = {
  number: "number",
  tuple: "numbers",
  picklist: "choice",
  boolean: "switch",
};

/** The schema inside `optional` and `nullable`, and whether null is a value. */
function inner(schema: SchemaNode): { node: SchemaNode; nullable: boolean } {
  let node = schema;
  let nullable = false;
  while (node.wrapped) {
    nullable ||= node.type === "nullable";
    node = node.wrapped;
  }
  return { node, nullable };
}

/** Least or most that a number's checks ask for. */
function bound(node: SchemaNode, check: "min_value" | "max_value", otherwise: number): number {
  const found = node.pipe?.find((p) => p.type === check)?.requirement;
  return typeof found === "number" ? found : otherwise;
}

/**
 * The fields of a thing that people may change, in the schema's order: those that say what they are called.
 *
 * @throws Error when a field with a name is of a type that no inspector shows.
 */
export function fieldsOf(thing: ThingName): readonly Field[] {
  return Object.entries(THING_SCHEMAS[thing].entries).flatMap(([key, schema]): Field[] => {
    const about = v.getMetadata(schema as v.GenericSchema) as Partial<FieldAbout>;
    if (about.label === undefined) return [];
    const { node, nullable } = inner(schema as unknown as SchemaNode);
    const kind = KINDS[node.type];
    if (!kind) throw new Error(`${thing}.${key}: fields of type ${node.type} are not shown.`);
    return [
      {
        key,
        kind,
        label: about.label,
        unit: about.unit ?? "",
        axes: about.axes ?? [],
        range: [
          bound(node, "min_value", Number.NEGATIVE_INFINITY),
          bound(node, "max_value", Number.POSITIVE_INFINITY),
        ],
        options: (node.options ?? []).map((value) => ({
          value,
          word: about.words?.[String(value)] ?? String(value),
        })),
        nullable,
        only: about.only ?? null,
        slider: about.slider ?? null,
      },
    ];
  });
}
