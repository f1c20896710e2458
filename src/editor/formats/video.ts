/**
 * The viewport as video, frame by frame, whatever the machine's speed: mediabunny encodes where the browser has WebCodecs,
 * MediaRecorder records in real time where it has not. Loaded when used.
 */
import type { Editor } from "../editor.ts";
import type { ExportFormat } from "./format.ts";
import { motionMissing } from "./motion.ts";

const RATE = 30;
const BITRATE = 8_000_000;

type Report = (share: number, fact: string) => void;

/** Encodes every frame; null when this browser encodes no codec we know. */
async function encode(
  e: Editor,
  canvas: HTMLCanvasElement,
  report: Report,
  signal: AbortSignal,
): Promise<Blob | null> {
  if (!("VideoEncoder" in window)) return null;
  const { BufferTarget, CanvasSource, getFirstEncodableVideoCodec, Output, WebMOutputFormat } = await import(
    "mediabunny"
  );
  const format = new WebMOutputFormat();
  // Encoders want even sizes: the picture is drawn on a canvas that has them.
  const even = document.createElement("canvas");
  even.width = canvas.width & ~1;
  even.height = canvas.height & ~1;
  const context = even.getContext("2d");
  const codec = await getFirstEncodableVideoCodec(["vp9", "vp8", "av1"], {
    width: even.width,
    height: even.height,
  });
  if (!codec || !context) return null;
  const output = new Output({ format, target: new BufferTarget() });
  const source = new CanvasSource(even, { codec, bitrate: BITRATE });
  output.addVideoTrack(source, { frameRate: RATE });
  await output.start();
  const frames = Math.max(1, Math.floor(e.plan.duration * RATE));
  e.stage.record(true);
  try {
    for (let f = 0; f < frames; f++) {
      if (signal.aborted) {
        await output.cancel();
        signal.throwIfAborted();
      }
      e.playback.seek(f / RATE);
      e.stage.drawNow();
      context.drawImage(canvas, 0, 0);
      await source.add(f / RATE, 1 / RATE);
      report((f + 1) / frames, `${f + 1} of ${frames} frames`);
    }
  } finally {
    e.stage.record(false);
  }
  await output.finalize();
  const { buffer } = output.target;
  if (!buffer) throw new Error("the encoder gave no video.");
  return new Blob([buffer], { type: "video/webm" });
}

/** Records the canvas while the motion plays. */
async function record(
  e: Editor,
  canvas: HTMLCanvasElement,
  report: Report,
  signal: AbortSignal,
): Promise<Blob> {
  if (!("MediaRecorder" in window)) throw new Error("this browser makes no videos.");
  const recorder = new MediaRecorder(canvas.captureStream(RATE), { videoBitsPerSecond: BITRATE });
  const parts: Blob[] = [];
  recorder.ondataavailable = (ev) => parts.push(ev.data);
  const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve, { once: true }));
  const { loop } = e.store.getState();
  e.set({ loop: false, time: 0 });
  recorder.start();
  e.playback.setPlaying(true);
  while (e.store.getState().playing && !signal.aborted) {
    const { time } = e.store.getState();
    report(time / e.plan.duration, `${time.toFixed(0)} of ${e.plan.duration.toFixed(0)} s`);
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  recorder.stop();
  await stopped;
  e.set({ loop });
  signal.throwIfAborted();
  return new Blob(parts, { type: recorder.mimeType });
}

export const videoExport: ExportFormat = {
  id: "video",
  label: "Video of the viewport (WebM)",
  file: ".webm",
  type: "video/webm",
  order: 301,
  blocked: motionMissing,
  async make(e) {
    const { time } = e.store.getState();
    const { canvas } = e.stage;
    const blob = await e.work.run(
      "Making the video",
      async (report, signal) =>
        (await encode(e, canvas, report, signal)) ?? (await record(e, canvas, report, signal)),
    );
    e.playback.seek(time);
    return blob;
  },
};
