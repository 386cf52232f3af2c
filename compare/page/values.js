// SPDX-License-Identifier: MIT
// The script of a report's page, in the order tables, values, card, gestures, address, index. It works
// from file://: it loads only images and scripts beside the page.

// ---- The values behind the images; compare/report/values.h defines the format.

const values = new Map();  // file -> its Values, or null while it is loading
const waiting = new Map();  // file -> functions to call once it is loaded

function half(bits) {
  const sign = bits >> 15 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

// Two characters for every 13 bits, and one for up to 6 bits at the end.
function base91Bytes(text) {
  const pairs = text.length >> 1, odd = text.length & 1, bytes = new Uint8Array(pairs * 13 + odd * 6 >> 3);
  const digit = i => text.charCodeAt(i) - 35 - (text.charCodeAt(i) > 92);
  let held = 0, bits = 0, at = 0;
  const put = (word, more) => {
    held |= word << bits;
    for (bits += more; bits > 7; bits -= 8, held >>>= 8) bytes[at++] = held;
  };
  for (let i = 0; i < 2 * pairs; i += 2) put(digit(i) * 91 + digit(i + 1), 13);
  if (odd) put(digit(2 * pairs), 6);
  return bytes;
}

// An empty text means all zeros.
async function inflated(text, bytes) {
  if (!text) return new Uint8Array(bytes);
  const stream = new Blob([base91Bytes(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// `smooth`: the data are differences to the left neighbours.
function wordsOf(raw, file, smooth) {
  const pixels = file.width * file.height, bytes = file.bits / 8;
  const words = file.bits === 16 ? new Uint16Array(pixels) : new Uint32Array(pixels);
  for (let i = 0; i < pixels; ++i) {
    let word = 0;
    for (let byte = 0; byte < bytes; ++byte) word |= raw[byte * pixels + i] << 8 * byte;
    words[i] = word + (smooth && i % file.width ? words[i - 1] : 0);
  }
  return words;
}

class Values {
  constructor(file, raws) {
    const { components: n, images } = file;
    this.file = file;
    this.planes = raws.map((raw, plane) => wordsOf(raw, file, plane < n));
    for (let plane = n; plane < n * images; ++plane)
      this.planes[plane].forEach((word, i, all) => { all[i] = word + this.planes[plane - n][i]; });
    if (file.bits === 32) this.planes = this.planes.map(words => new Float32Array(words.buffer));
  }
  number(plane, pixel, unit) {
    const word = this.planes[plane][pixel];
    return (this.file.bits === 32 ? word : half(word)) * unit;
  }
  of(image, pixel) {
    const { components: n, exponent } = this.file;
    return Array.from({ length: n }, (_, c) => this.number(image * n + c, pixel, 2 ** -exponent));
  }
  error(pixel) {
    return this.file.errors ? this.number(this.planes.length - 1, pixel, this.file.errorUnit) : 0;
  }
  // The shortest decimal that identifies the number; for a quantised one only its significant digits.
  text(number) {
    if (!this.file.exact || !Number.isFinite(number)) return String(+number.toPrecision(4));
    for (let digits = 1; digits < 9; ++digits) {
      const short = +number.toPrecision(digits);
      if (Math.fround(short) === number) return String(short);
    }
    return String(+number.toPrecision(9));
  }
}

window.diptychValues = async (name, file) => {
  const bytes = file.width * file.height * file.bits / 8;
  values.set(name, new Values(file, await Promise.all(file.data.map(text => inflated(text, bytes)))));
  for (const then of waiting.get(name) || []) then();
  waiting.delete(name);
};

// The name may come from another machine's report, so only a script in the page's folder is accepted.
function addScript(name, failed) {
  const script = document.createElement('script'), url = new URL(name, location);
  if (!url.href.startsWith(new URL('.', location).href) || !url.pathname.endsWith('.js')) return failed();
  script.src = url;
  script.onerror = failed;
  document.head.append(script);
}
