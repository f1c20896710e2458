/** A scene in a link: compressed into the address after `#s=`, so that no server ever sees it. */
import { readScene } from "../../core/scene/schema.ts";
import type { Scene } from "../../core/scene/types.ts";

const MARK = "#s=";
/** Largest scene that a link may unfold to, bytes. */
const MOST = 4_000_000;
/** Bytes of a link that are unfolded before the size is looked at; deflate makes them a thousandfold at most. */
const PIECE = 1024;
/** Longest address that is handed out, characters: mail programs and chats cut longer ones. */
export const LONGEST_LINK = 30_000;

const toBase64 = (bytes: Uint8Array): string => {
  let text = "";
  for (let i = 0; i < bytes.length; i += 0x8000)
    text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
};

function fromBase64(text: string): Uint8Array {
  const plain = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(plain, (c) => c.charCodeAt(0));
}

/** The part of an address from `#` on that carries a scene and its name. */
export async function sceneToHash(scene: Scene, name: string): Promise<string> {
  const { deflateSync, strToU8 } = await import("fflate");
  return MARK + toBase64(deflateSync(strToU8(JSON.stringify({ name, scene })), { level: 9 }));
}

/** Whether an address's hash claims to carry a scene. */
export const carriesScene = (hash: string): boolean => hash.startsWith(MARK);

/**
 * The scene of an address's hash.
 *
 * @throws Error with one sentence that begins with "This link".
 */
export async function sceneFromHash(hash: string): Promise<{ scene: Scene; name: string }> {
  const { Inflate, strFromU8 } = await import("fflate");
  const parts: Uint8Array[] = [];
  let size = 0;
  try {
    const inflate = new Inflate((chunk) => {
      size += chunk.length;
      // A few bytes can unfold to gigabytes.
      if (size > MOST) throw new RangeError("too large");
      parts.push(chunk);
    });
    const packed = fromBase64(hash.slice(MARK.length));
    // What is pushed is unfolded at once: a piece is a megabyte at most.
    for (let at = 0; at < packed.length; at += PIECE)
      inflate.push(packed.subarray(at, at + PIECE), at + PIECE >= packed.length);
  } catch (error) {
    throw new Error(
      error instanceof RangeError
        ? `This link holds more than ${MOST / 1e6} MB; scenes that large are sent as files.`
        : "This link is cut short or damaged. Ask for it again, or for the scene as a file.",
    );
  }
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const p of parts) {
    bytes.set(p, at);
    at += p.length;
  }
  let value: { name?: unknown; scene?: unknown };
  try {
    value = Object(JSON.parse(strFromU8(bytes))) as typeof value;
  } catch {
    throw new Error("This link is cut short or damaged. Ask for it again, or for the scene as a file.");
  }
  const name = typeof value.name === "string" && value.name !== "" ? value.name.slice(0, 80) : "Shared scene";
  return { scene: readScene(JSON.stringify(value.scene ?? null), "This link"), name };
}
