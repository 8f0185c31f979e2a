// Unpacks the data of replays and plots: base64 of deflated JSON, of a limited size.

const MAX_CHARACTERS = 4e6, MAX_BYTES = 16e6; // of compressed and decompressed data

async function unpack(packed) {
  if (packed.length > MAX_CHARACTERS) refuse("less data");
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const decoder = new TextDecoder();
  let json = "";
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    json += decoder.decode(piece.value, { stream: true });
    if (json.length > MAX_BYTES) { await reader.cancel(); refuse("less data"); }
  }
  return JSON.parse(json);
}
