/** Base64 as the contract uses it: little-endian numbers, which is the byte order of every browser's machine. */

function bytes(text) {
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < out.length; i++) out[i] = binary.charCodeAt(i);
  return out;
}

const kinds = { f32: Float32Array, f64: Float64Array, u8: Uint8Array };

/** @param {string} text @param {'f32'|'f64'|'u8'} kind */
export function decode(text, kind) {
  const raw = bytes(text);
  const Kind = kinds[kind];
  if (raw.length % Kind.BYTES_PER_ELEMENT) throw new RangeError('not a whole number of elements');
  return new Kind(raw.buffer);
}
