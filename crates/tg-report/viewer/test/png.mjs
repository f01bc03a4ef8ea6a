import { inflateSync } from 'node:zlib';

/** Decodes the PNG that a browser's screenshot gives (8 bits, RGB or RGBA, not interlaced) to its raw pixels. */
export function decode(png) {
  const width = png.readUInt32BE(16);
  const height = png.readUInt32BE(20);
  const channels = { 2: 3, 6: 4 }[png[25]];
  const parts = [];
  for (let at = 8; at < png.length; ) {
    const length = png.readUInt32BE(at);
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(png.subarray(at + 8, at + 8 + length));
    at += length + 12;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const pixels = new Uint8Array(stride * height);
  const paeth = (left, above, corner) => {
    const guess = left + above - corner;
    const pl = Math.abs(guess - left), pa = Math.abs(guess - above), pc = Math.abs(guess - corner);
    return pl <= pa && pl <= pc ? left : pa <= pc ? above : corner;
  };
  for (let y = 0; y < height; y++) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; x++) {
      const at = y * stride + x;
      const left = x >= channels ? pixels[at - channels] : 0;
      const above = y ? pixels[at - stride] : 0;
      let guess = 0;
      if (filter === 1) guess = left;
      else if (filter === 2) guess = above;
      else if (filter === 3) guess = (left + above) >> 1;
      else if (filter === 4) guess = paeth(left, above, x >= channels && y ? pixels[at - channels - stride] : 0);
      pixels[at] = raw[at + y + 1] + guess;
    }
  }
  return { width, height, channels, pixels };
}

export function distinctColours({ pixels, channels }) {
  const seen = new Set();
  for (let i = 0; i < pixels.length; i += channels) seen.add((pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2]);
  return seen.size;
}

export function differingPixels(a, b) {
  let count = 0;
  for (let i = 0; i < a.pixels.length; i += a.channels) {
    let far = 0;
    for (let c = 0; c < 3; c++) far = Math.max(far, Math.abs(a.pixels[i + c] - b.pixels[i + c]));
    if (far > 24) count++;
  }
  return count;
}
