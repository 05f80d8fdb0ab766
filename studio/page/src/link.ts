// Files in the fragment of an address: compressed, in the letters of base64url. Addresses of more than 64 KB are not
// made, as not everything that passes them on keeps longer ones.

export interface Linked {
  files: Record<string, string>; // texts by their paths
  open: string;
}

const MARK = "#t1.";
export const LONGEST = 65_536;
const MOST_TEXT = 8_388_608; // of what a link is unpacked to

async function through(bytes: BlobPart, stream: CompressionStream | DecompressionStream, most = Infinity): Promise<Uint8Array> {
  const reader = new Blob([bytes]).stream().pipeThrough(stream as unknown as ReadableWritablePair<Uint8Array, Uint8Array>).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const {done, value} = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new Error("the link holds too much");
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

// The fragment for these files; null if it would be too long.
export async function fragmentOf(linked: Linked): Promise<string | null> {
  const packed = await through(new TextEncoder().encode(JSON.stringify(linked)), new CompressionStream("deflate-raw"));
  let letters = "";
  for (let i = 0; i < packed.length; i += 0x8000) letters += String.fromCharCode(...packed.subarray(i, i + 0x8000));
  const fragment = MARK + btoa(letters).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
  return fragment.length <= LONGEST ? fragment : null;
}

// The files of a fragment; null if it is none of ours, or is damaged.
export async function linkedOf(fragment: string): Promise<Linked | null> {
  if (!fragment.startsWith(MARK) || fragment.length > LONGEST) return null;
  try {
    const letters = atob(fragment.slice(MARK.length).replace(/-/g, "+").replace(/_/g, "/"));
    const packed = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const found = JSON.parse(new TextDecoder("utf-8", {fatal: true}).decode(await through(packed, new DecompressionStream("deflate-raw"), MOST_TEXT)));
    const files = Object.entries(found.files ?? {});
    if (!files.length || files.some(([path, text]) => typeof text !== "string" || !/^[^/\\\0][^\\\0]*$/.test(path) || path.split("/").includes(".."))) return null;
    return {files: Object.fromEntries(files) as Record<string, string>, open: typeof found.open === "string" && found.open in found.files ? found.open : files[0][0]};
  } catch {
    return null;
  }
}
