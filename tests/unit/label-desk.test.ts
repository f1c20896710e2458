import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { asLabelled, asRested, learnHabit } from "../../src/core/contacts/convention.ts";
import { packExamples, unpackExamples } from "../../src/core/contacts/examples.ts";
import { LabelTrack } from "../../src/core/contacts/label-track.ts";
import { encodeOracle } from "../../src/core/contacts/model-file.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { OWN_ORACLE, trainOracle } from "../../src/core/contacts/oracle.ts";
import { DEFAULT_PROPORTIONS } from "../../src/core/skeleton/skeleton.ts";
import { decodeLibrary } from "../../src/core/templates/library-file.ts";
import { captureLayer } from "../../src/editor/captures/layer.ts";
import type { CaptureSession } from "../../src/editor/captures/session.ts";
import { taskHere } from "../../src/editor/captures/task-here.ts";
import type { Editor } from "../../src/editor/editor.ts";
import { contactTracks } from "../../src/plots/contact-tracks.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";
import type { ContactsRequest, ContactsResponse } from "../../src/workers/contacts-protocol.ts";
import { createContactsService } from "../../src/workers/contacts-service.ts";

const track = (text: string): LabelTrack => new LabelTrack(Uint8Array.from(text, (c) => (c === "#" ? 1 : 0)));
const text = (t: LabelTrack, bit = 0): string =>
  Array.from({ length: t.frames }, (_, f) => (t.at(bit, f) ? "#" : ".")).join("");

describe("labels that a person corrects", () => {
  it("edges go where the cursor is, to the run at hand or the nearest one", () => {
    const t = track("..####....##..");
    t.moveTo(4);
    t.startHere();
    expect(text(t)).toBe("....##....##..");
    t.moveTo(8);
    t.startHere();
    expect(text(t)).toBe("....##..####..");
    t.moveTo(9);
    t.endHere();
    expect(text(t)).toBe("....##..##....");
    t.moveTo(12);
    t.endHere();
    expect(text(t)).toBe("....##..#####.");
    t.clearHere();
    expect(text(t)).toBe("....##........");
  });

  it("a stroke of the brush is one entry; undo and redo go over it", () => {
    const t = track("..........");
    t.moveTo(2);
    t.toggleBrush();
    t.moveTo(5);
    t.moveTo(6);
    t.toggleBrush();
    expect(text(t)).toBe("..#####...");
    t.moveTo(4);
    t.toggleBrush();
    t.moveTo(5);
    t.toggleBrush();
    expect(text(t)).toBe("..##..#...");
    t.undo();
    expect(text(t)).toBe("..#####...");
    t.undo();
    expect(text(t)).toBe("..........");
    expect(t.canUndo).toBe(false);
    t.redo();
    t.redo();
    expect(text(t)).toBe("..##..#...");
  });

  it("a dragged edge never passes the other end, and a drag that is given up leaves nothing", () => {
    const t = track("..####....");
    t.begin();
    const at = t.moveEdge(0, 6, 9);
    expect(text(t)).toBe("..#######.");
    expect(t.moveEdge(0, at, 0)).toBe(3);
    expect(text(t)).toBe("..#.......");
    t.cancel();
    expect(text(t)).toBe("..####....");
    expect(t.canUndo).toBe(false);
    t.moveEdge(0, 2, 0);
    expect(text(t)).toBe("######....");
  });

  it("what is confirmed stays when the oracle thinks otherwise", () => {
    const t = track("####......");
    t.confirm(0, 5);
    t.fill(new Uint8Array(10).fill(1));
    expect(text(t)).toBe("####.#####");
    expect(() => t.fill(new Uint8Array(3))).toThrow("they are of another clip");
    t.undo();
    t.fill(new Uint8Array(10));
    expect(text(t)).toBe("..........");
  });

  it("what is painted stays when the oracle thinks otherwise, on its own track", () => {
    const t = track("..........");
    t.paint(0, 2, 4, 1);
    t.fill(new Uint8Array(10).fill(2));
    expect(text(t)).toBe("..##......");
    expect(text(t, 1)).toBe("##########");
    t.undo();
    t.fill(new Uint8Array(10).fill(3));
    expect(text(t)).toBe("##########");
  });

  it("thoughts of an oracle that has learned other labels than those now confirmed are left", () => {
    const t = track("####......");
    const learned = t.confirmed.slice();
    t.confirm(0, 10);
    expect(t.fill(new Uint8Array(10).fill(1), learned)).toBe(false);
    t.undo();
    expect(t.fill(new Uint8Array(10).fill(1), new Uint8Array(10).fill(1))).toBe(false);
    expect(text(t)).toBe("####......");
    expect(t.fill(new Uint8Array(10), learned)).toBe(true);
    expect(text(t)).toBe("..........");
  });

  it("after any edits, undo goes back to the beginning step by step (seed 3)", () => {
    const edit = fc.record({
      what: fc.constantFrom("start", "end", "clear", "brush", "paint", "confirm"),
      at: fc.nat(39),
      to: fc.nat(40),
      track: fc.nat(3),
    });
    fc.assert(
      fc.property(
        fc.uint8Array({ minLength: 40, maxLength: 40, max: 15 }),
        fc.array(edit),
        (labels, edits) => {
          const t = new LabelTrack(labels);
          for (const e of edits) {
            t.pick(e.track);
            t.moveTo(e.at);
            if (e.what === "start") t.startHere();
            else if (e.what === "end") t.endHere();
            else if (e.what === "clear") t.clearHere();
            else if (e.what === "paint") t.paint(e.track, e.at, e.to, 1);
            else if (e.what === "confirm") t.confirm(Math.min(e.at, e.to), Math.max(e.at, e.to));
            else {
              t.toggleBrush();
              t.moveTo(Math.min(39, e.to));
              t.toggleBrush();
            }
          }
          while (t.undo());
          expect([...t.labels]).toEqual([...labels]);
          expect(t.confirmed.includes(1)).toBe(false);
        },
      ),
      { seed: 3, numRuns: 60 },
    );
  });

  it("is drawn with a bar for each run, unsure ones dashed with their number", () => {
    const picture = contactTracks({
      width: 900,
      height: 300,
      first: 0,
      last: 100,
      cursor: 20,
      track: 0,
      brush: false,
      tracks: [
        [
          { from: 5, to: 30, sure: null },
          { from: 50, to: 70, sure: 0.52 },
        ],
        [],
        [],
        [{ from: 0, to: 100, sure: 0.99 }],
      ],
      heights: new Float32Array(400),
      speeds: new Float32Array(400),
    });
    expect(picture.match(/data-run/g)).toHaveLength(3);
    expect(picture.match(/stroke-dasharray="4 3"><title>/g)).toHaveLength(1);
    expect(picture).toContain("0.52 sure");
    expect(picture).not.toContain("NaN");
  });
});

describe("what labels mean", () => {
  it("labels begin before the rest and end after it; back again they are the rest", () => {
    const exact = Uint8Array.from("..........######..........", (c) => (c === "#" ? 15 : 0));
    const labelled = asLabelled(exact);
    const of = (bit: number): string => Array.from(labelled, (b) => ((b >> bit) & 1 ? "#" : ".")).join("");
    expect(of(0)).toBe("........##########........");
    expect(of(1)).toBe("........#########.........");
    expect([...asRested(labelled)]).toEqual([...exact]);
    // The habit of whoever labels is found again in what they labelled.
    const habit = { heelLead: 3, heelLag: 0, toeLead: 1, toeLag: 2 };
    expect(learnHabit([{ exact, labels: asLabelled(exact, habit) }])).toEqual(habit);
  });

  it("examples are the same after packing (seed 4)", () => {
    const size = 6;
    const count = 11;
    const features = Float32Array.from({ length: size * count }, (_, i) => ((i * 37) % 256) / 48);
    const labels = Uint8Array.from({ length: count }, (_, i) => i & 3);
    const again = unpackExamples(packExamples({ size, count, features, labels }), size, count);
    expect([...again.features]).toEqual([...features]);
    expect([...again.labels]).toEqual([...labels]);
    expect(() => unpackExamples(new Uint8Array(5), size, count)).toThrow(RangeError);
  });
});

describe("the worker of captures", () => {
  const rendered = studioSet()
    .slice(0, 2)
    .map(({ name, score }) => ({ name, ...renderScore(score) }));
  const teacher = trainOracle(
    [
      {
        track: trackOf(rendered[1].clip),
        labels: asLabelled(rendered[1].contacts),
        mask: Uint8Array.from(rendered[1].contacts, (_, f) => (f % 6 === 0 ? 1 : 0)),
      },
    ],
    OWN_ORACLE,
  );
  const bvh = writeBvh(rendered[0].clip);

  function service() {
    const heard: ContactsResponse[] = [];
    const send = createContactsService((m) => heard.push(m));
    const ask = async <T extends ContactsResponse["type"]>(
      request: ContactsRequest,
      _type: T,
    ): Promise<Extract<ContactsResponse, { type: T }>> => {
      await send(request);
      const last = heard.at(-1);
      expect(last?.type).toBe(_type);
      return last as Extract<ContactsResponse, { type: T }>;
    };
    return { heard, send, ask };
  }

  it("opens a capture with progress, learns from labels, cleans, and makes a library", async () => {
    const { heard, ask } = service();
    await ask({ type: "model", bytes: encodeOracle(teacher), name: "m.bin" }, "ready");
    const opened = await ask(
      { type: "open", id: 1, key: "a", name: "a.bvh", file: new Blob([bvh]), mapping: null },
      "opened",
    );
    expect(heard.filter((m) => m.type === "progress").length).toBeGreaterThan(2);
    expect(opened.clip.frames).toBe(rendered[0].clip.frames);
    expect(opened.thought.labels.length).toBe(opened.clip.frames);
    const truth = asLabelled(rendered[0].contacts);
    const trained = await ask(
      {
        type: "train",
        id: 2,
        lessons: [{ key: "a", labels: truth, mask: truth.map((_, f) => (f % 4 === 0 ? 1 : 0)) }],
      },
      "trained",
    );
    expect(trained.examples).toBe(teacher.index.count + 2 * Math.ceil(truth.length / 4));
    const wrong = trained.thoughts[0].labels.reduce((n, l, f) => n + (l === truth[f] ? 0 : 1), 0);
    expect(wrong / truth.length).toBeLessThan(0.05);
    expect(trained.segments[0].foreign).toBeGreaterThan(0);
    const steps = await ask({ type: "steps", id: 3, key: "a", contacts: truth, tasks: [] }, "steps");
    expect(steps.steps.length).toBeGreaterThan(4);
    const cleaned = await ask({ type: "clean", id: 4, key: "a", contacts: truth }, "cleaned");
    expect(cleaned.skate[1]).toBeLessThan(2.5);
    expect(cleaned.text.split("\n").length).toBe(bvh.split("\n").length);
    const tasks = rendered[0].sidecar.tasks;
    const library = await ask(
      { type: "library", id: 5, entries: [{ key: "a", contacts: truth, tasks, steps: null }] },
      "library",
    );
    expect(decodeLibrary(library.bytes).templates.length).toBe(library.templates);
    expect(library.templates).toBeGreaterThan(0);
  });

  it("stops what is cancelled, names what is wrong, and opens again with another mapping", async () => {
    const { heard, send, ask } = service();
    await ask({ type: "model", bytes: encodeOracle(teacher), name: "m.bin" }, "ready");
    const opening = send({
      type: "open",
      id: 7,
      key: "a",
      name: "a.bvh",
      file: new Blob([bvh]),
      mapping: null,
    });
    void send({ type: "cancel", id: 7 });
    await opening;
    expect(heard.at(-1)).toEqual({ type: "cancelled", id: 7 });
    const broken = await ask(
      { type: "open", id: 8, key: "b", name: "b.bvh", file: new Blob(["HIERARCHY\nROOT"]), mapping: null },
      "failed",
    );
    expect(broken.message).toMatch(/^b\.bvh, line \d+:/);
    const closed = await ask(
      { type: "steps", id: 9, key: "c", contacts: new Uint8Array(1), tasks: [] },
      "failed",
    );
    expect(closed.message).toBe("c: this capture is not open.");
    const noToes = bvh.replaceAll(/(left|right)Toes/g, "$1Thing");
    const opened = await ask(
      { type: "open", id: 10, key: "d", name: "d.bvh", file: new Blob([noToes]), mapping: null },
      "opened",
    );
    expect(opened.report.missing).toEqual(["leftToes", "rightToes"]);
    expect(opened.report.warnings[0]).toContain("This skeleton has no toes.");
    const mapping = { ...opened.report.mapped, leftToes: "leftThing", rightToes: "rightThing" };
    const again = await ask(
      { type: "open", id: 11, key: "d", name: "d.bvh", file: new Blob([noToes]), mapping },
      "opened",
    );
    expect(again.report.missing).toEqual([]);
    expect(again.report.warnings).toEqual([]);
  });

  it("a task marked on a capture takes the place of hand or hips at that moment", () => {
    const { clip, sidecar } = rendered[0];
    const task = sidecar.tasks.find((t) => t.category === "write");
    expect(task).toBeDefined();
    const edits = new LabelTrack(new Uint8Array(clip.frames));
    edits.moveTo((task?.contact ?? 0) * clip.rate);
    const data = {
      frames: clip.frames,
      rate: clip.rate,
      height: clip.skeleton.height,
      root: Float32Array.from(clip.root),
      rotations: Float32Array.from(clip.rotations),
    };
    const marked = taskHere({ clip: data, edits }, "write");
    const to = task?.position ?? [0, 0, 0];
    expect(Math.hypot(...marked.position.map((v, k) => v - to[k]))).toBeLessThan(0.2);
    expect(marked.contact).toBeCloseTo(task?.contact ?? 0, 1);
  });

  it("the stretch at hand is framed whole; who leaves the desk finds the scene's figure and view again", () => {
    const { clip } = rendered[0];
    const edits = new LabelTrack(new Uint8Array(clip.frames));
    const data = {
      frames: clip.frames,
      rate: clip.rate,
      height: clip.skeleton.height,
      root: clip.root,
      rotations: clip.rotations,
    };
    const seen = { frames: 0, poses: 0, shows: 0 };
    let open = false;
    const session = {
      current: { key: "c", clip: data, edits, cleaned: null },
      stretch: { first: 0, last: 200 },
      deskOpen: true,
      feetShown: null,
    };
    const layer = captureLayer(
      {
        store: {
          getState: () => ({ scene: { character: { height: 1.75, proportions: DEFAULT_PROPORTIONS } } }),
        },
        stage: {
          setPose: () => seen.poses++,
          invalidate: () => undefined,
          setOpen: (now: boolean) => {
            open = now;
          },
        },
        frameScene: () => seen.frames++,
        playback: { show: () => seen.shows++ },
      } as unknown as Editor,
      session as unknown as CaptureSession,
    );
    layer.draw();
    layer.draw();
    expect(seen).toEqual({ frames: 1, poses: 2, shows: 0 });
    const points = layer.frames?.() ?? [];
    expect(points).toHaveLength(8);
    const way = Math.hypot(clip.root[3 * 199] - clip.root[0], clip.root[3 * 199 + 2] - clip.root[2]);
    const [a, b] = [points[0], points[7]];
    expect(Math.hypot(b[0] - a[0], b[2] - a[2])).toBeCloseTo(way, 2);
    // A way of some steps is in the room; one as long as a sprint's has the floor without walls.
    expect(way).toBeLessThan(6);
    expect(open).toBe(false);
    session.stretch = { first: 200, last: 400 };
    layer.draw();
    expect(seen).toEqual({ frames: 2, poses: 3, shows: 0 });
    const far = data.root.map((x, k) => x + (k % 3 === 2 ? k / 30 : 0));
    session.current = { ...session.current, key: "far", clip: { ...data, root: far } };
    layer.draw();
    expect(open).toBe(true);
    session.current = { ...session.current, key: "c", clip: data };
    layer.draw();
    expect(open).toBe(false);
    seen.frames = 2;
    seen.poses = 3;
    session.deskOpen = false;
    layer.draw();
    layer.draw();
    expect(seen).toEqual({ frames: 3, poses: 3, shows: 1 });
    expect(layer.frames?.()).toBeNull();
  });
});
