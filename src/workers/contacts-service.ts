/** The worker of captures: see contacts-protocol.ts. It knows no worker, so that tests can drive it. */
import { type BvhFile, createBvhReader } from "../core/capture/bvh-parse.ts";
import type { Clip } from "../core/capture/clip.ts";
import { importBvhFile, jointsOf } from "../core/capture/import.ts";
import { cleanBvh } from "../core/cleanup/clean-bvh.ts";
import { rewriteBvh } from "../core/cleanup/file-motion.ts";
import { plantSlides, slideP95 } from "../core/cleanup/slides.ts";
import { rankDistances } from "../core/contacts/active-learning.ts";
import { asRested } from "../core/contacts/convention.ts";
import { footCurves } from "../core/contacts/curves.ts";
import { decodeOracle, encodeOracle } from "../core/contacts/model-file.ts";
import { type MotionTrack, trackOf } from "../core/contacts/motion-track.ts";
import { askInSlices, type Oracle, type OracleAnswer, trainOracle } from "../core/contacts/oracle.ts";
import { JOINT_NAMES, type JointName } from "../core/skeleton/joints.ts";
import { assembleLibrary, prepareClip } from "../core/templates/build-library.ts";
import { encodeLibrary } from "../core/templates/library-file.ts";
import type { ClipData, ContactsRequest, ContactsResponse, Thought } from "./contacts-protocol.ts";

/** Frames asked between two looks at the inbox. */
const SLICE = 120;
/** Votes, of one, from which the oracle is sure. */
const SURE = 0.9;

export type PostContacts = (message: ContactsResponse, transfer?: Transferable[]) => void;

interface Opened {
  name: string;
  head: string;
  file: BvhFile;
  joints: Map<JointName, number>;
  clip: Clip;
  track: MotionTrack;
  answer: OracleAnswer;
}

class Cancelled extends Error {}

/** @returns what takes the requests; each returns when it is done with. */
export function createContactsService(post: PostContacts): (request: ContactsRequest) => Promise<void> {
  const opened = new Map<string, Opened>();
  const cancelled = new Set<number>();
  /** The model to begin with, and what it has become. */
  let first: Oracle | null = null;
  let oracle: Oracle | null = null;
  let queue: Promise<void> = Promise.resolve();

  const model = (): Oracle => {
    if (!oracle) throw new Error("The oracle is not loaded yet.");
    return oracle;
  };
  const known = (key: string): Opened => {
    const found = opened.get(key);
    if (!found) throw new Error(`${key}: this capture is not open.`);
    return found;
  };
  /** Lets messages in, and stops a request that was cancelled meanwhile. */
  const breathe = async (id: number): Promise<void> => {
    await new Promise((resolve) => setTimeout(resolve, 0));
    if (cancelled.delete(id)) throw new Cancelled();
  };

  const ask = async (id: number, name: string, track: MotionTrack): Promise<OracleAnswer> => {
    const asked = askInSlices(model(), track, SLICE);
    for (;;) {
      const step = asked.next();
      if (step.done) return step.value;
      post({ type: "progress", id, doing: "contacts", name, share: step.value });
      await breathe(id);
    }
  };

  const read = async (id: number, name: string, blob: Blob): Promise<{ file: BvhFile; head: string }> => {
    const reader = createBvhReader(name, blob.size);
    const decoder = new TextDecoder();
    let head = "";
    let done = 0;
    const source = blob.stream().getReader();
    try {
      for (let next = await source.read(); !next.done; next = await source.read()) {
        const piece = decoder.decode(next.value, { stream: true });
        // What stands before the numbers is written again as it was.
        if (!/Frame\s+Time\s*:[^\r\n]*[\r\n]/i.test(head)) head += piece;
        reader.push(piece);
        done += next.value.length;
        post({ type: "progress", id, doing: "reading", name, share: blob.size > 0 ? done / blob.size : 1 });
        await breathe(id);
      }
      reader.push(decoder.decode());
      return { file: reader.end(), head };
    } catch (error) {
      await source.cancel();
      throw error;
    }
  };

  const open = async (r: Extract<ContactsRequest, { type: "open" }>): Promise<void> => {
    const { file, head } = await read(r.id, r.name, r.file);
    post({ type: "progress", id: r.id, doing: "importing", name: r.name, share: 0 });
    await breathe(r.id);
    const joints = r.mapping ? mapped(file, r.mapping) : jointsOf(file);
    const { clip, report } = importBvhFile(file, joints);
    const track = trackOf(clip);
    const answer = await ask(r.id, r.name, track);
    opened.set(r.key, { name: r.name, head, file, joints, clip, track, answer });
    const data = clipData(clip);
    const curves = footCurves(track);
    const thought = thoughtOf(r.key, answer);
    post(
      {
        type: "opened",
        id: r.id,
        key: r.key,
        report,
        joints: file.joints.map((j) => j.name),
        clip: data,
        curves,
        thought,
      },
      [data.root.buffer, data.rotations.buffer, curves.heights.buffer, curves.speeds.buffer],
    );
  };

  const train = async (r: Extract<ContactsRequest, { type: "train" }>): Promise<void> => {
    const base = first ?? model();
    const lessons = r.lessons.filter((l) => l.mask.includes(1));
    const next = trainOracle(
      [
        ...base.sources,
        ...lessons.map((l) => ({ track: known(l.key).track, labels: l.labels, mask: l.mask })),
      ],
      base.options,
      base.base,
    );
    const before = oracle;
    oracle = next;
    try {
      for (const o of opened.values()) o.answer = await ask(r.id, o.name, o.track);
    } catch (error) {
      oracle = before;
      throw error;
    }
    let sure = 0;
    let all = 0;
    for (const o of opened.values())
      for (const v of o.answer.share) {
        all++;
        if (v >= SURE || v <= 1 - SURE) sure++;
      }
    const keys = [...opened.keys()];
    const segments = rankDistances(keys.map((k) => known(k).answer.distance));
    post({
      type: "trained",
      id: r.id,
      examples: next.index.count,
      sure: all > 0 ? sure / all : 0,
      thoughts: keys.map((k) => thoughtOf(k, known(k).answer)),
      keys,
      segments,
    });
  };

  const clean = async (r: Extract<ContactsRequest, { type: "clean" }>): Promise<void> => {
    const o = known(r.key);
    post({ type: "progress", id: r.id, doing: "cleaning", name: o.name, share: 0 });
    await breathe(r.id);
    const { file, report } = cleanBvh(o.file, o.clip, r.contacts, o.joints);
    post({ type: "progress", id: r.id, doing: "cleaning", name: o.name, share: 0.6 });
    await breathe(r.id);
    const { clip } = importBvhFile(file, o.joints);
    const skate: [number, number] = [
      slideP95(plantSlides(o.file, o.clip, r.contacts, o.joints)),
      slideP95(plantSlides(file, o.clip, r.contacts, o.joints)),
    ];
    const data = clipData(clip);
    post(
      { type: "cleaned", id: r.id, key: r.key, text: rewriteBvh(o.head, file), clip: data, report, skate },
      [data.root.buffer, data.rotations.buffer],
    );
  };

  const handle = async (r: ContactsRequest): Promise<void> => {
    switch (r.type) {
      case "model": {
        const bytes = "bytes" in r ? r.bytes : await fetchModel(r.url);
        first = decodeOracle(bytes, "name" in r ? r.name : r.url);
        oracle = first;
        post({ type: "ready", examples: first.index.count });
        return;
      }
      case "open":
        return open(r);
      case "train":
        return train(r);
      case "clean":
        return clean(r);
      case "steps": {
        const o = known(r.key);
        const prepared = prepareClip({
          name: o.name,
          clip: o.clip,
          tasks: r.tasks,
          contacts: asRested(r.contacts),
        });
        post({ type: "steps", id: r.id, key: r.key, steps: prepared.steps });
        return;
      }
      case "library": {
        const clips = r.entries.map((e) => {
          const o = known(e.key);
          const name = `own/${e.key}`;
          const clip = { ...o.clip, name };
          const made = prepareClip({ name, clip, tasks: e.tasks, contacts: asRested(e.contacts) });
          return e.steps ? { ...made, steps: e.steps } : made;
        });
        const library = assembleLibrary(clips, true);
        const bytes = encodeLibrary(library);
        post(
          {
            type: "library",
            id: r.id,
            bytes,
            clips: library.clips.length,
            templates: library.templates.length,
            walks: library.walks.length,
          },
          [bytes.buffer],
        );
        return;
      }
      case "save": {
        const bytes = encodeOracle(model());
        post({ type: "saved", id: r.id, bytes }, [bytes.buffer]);
        return;
      }
      case "close":
        opened.delete(r.key);
        return;
      case "cancel":
        return;
    }
  };

  return (request) => {
    // A cancel overtakes what waits and what is under way.
    if (request.type === "cancel") {
      cancelled.add(request.id);
      return Promise.resolve();
    }
    const id = "id" in request ? request.id : 0;
    queue = queue.then(async () => {
      try {
        if (cancelled.delete(id)) throw new Cancelled();
        await handle(request);
      } catch (error) {
        if (error instanceof Cancelled) post({ type: "cancelled", id });
        else post({ type: "failed", id, message: error instanceof Error ? error.message : String(error) });
      }
      cancelled.delete(id);
    });
    return queue;
  };
}

async function fetchModel(url: string): Promise<Uint8Array> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: the starting oracle could not be loaded (${answer.status}).`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** A person's mapping: our joint to a name in the file. @throws Error for names that are not there. */
function mapped(file: BvhFile, mapping: Record<string, string>): Map<JointName, number> {
  const out = new Map<JointName, number>();
  for (const ours of JOINT_NAMES) {
    const name = mapping[ours] ?? "";
    if (name === "") continue;
    const index = file.joints.findIndex((j) => j.name === name);
    if (index < 0) throw new Error(`${file.name}: there is no joint ${name}.`);
    out.set(ours, index);
  }
  return out;
}

const thoughtOf = (key: string, answer: OracleAnswer): Thought => ({
  key,
  labels: answer.labels.slice(),
  share: answer.share.slice(),
});

function clipData(clip: Clip): ClipData {
  return {
    frames: clip.frames,
    rate: clip.rate,
    height: clip.skeleton.height,
    root: Float32Array.from(clip.root),
    rotations: Float32Array.from(clip.rotations),
  };
}
