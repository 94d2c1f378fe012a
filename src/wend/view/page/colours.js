// From half floats to colours on the screen, by tables of all halves.

const floatOfHalf = (() => {
  const table = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const sign = h & 0x8000 ? -1 : 1, exponent = (h >> 10) & 31, fraction = h & 1023;
    if (exponent === 31) table[h] = fraction ? NaN : sign * Infinity;
    else if (exponent === 0) table[h] = sign * fraction * 2 ** -24;
    else table[h] = sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  }
  return table;
})();

export const decode = (half) => floatOfHalf[half];

const toSrgb = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
const curves = {
  srgb: (x) => toSrgb(Math.min(Math.max(x, 0), 1)),
  // A film's response as K. Narkowicz fits it: bright lights keep their shape.
  filmic: (x) => {
    const y = Math.max(x, 0) * 0.6;
    return toSrgb(Math.min((y * (2.51 * y + 0.03)) / (y * (2.43 * y + 0.59) + 0.14), 1));
  },
};

/** For each half its byte on the screen. */
export function toneTable(exposure, tone) {
  const table = new Uint8ClampedArray(65536), scale = 2 ** exposure;
  for (let h = 0; h < 65536; ++h) {
    const value = floatOfHalf[h];
    table[h] = Number.isNaN(value) ? 255 : 255 * curves[tone](value === Infinity ? 1e9 : value * scale);
  }
  return table;
}

// Lightness grows evenly: from near black over violet and orange to pale yellow.
const stops = [[0, 0, 4], [40, 11, 84], [101, 21, 110], [159, 42, 99], [212, 72, 66], [245, 125, 21], [250, 193, 39], [252, 255, 164]];

/** The colour at a place from 0 to 1. */
export function falseColour(place) {
  if (Number.isNaN(place)) return stops[stops.length - 1];
  const x = Math.min(Math.max(place, 0), 1) * (stops.length - 1), i = Math.min(Math.floor(x), stops.length - 2);
  return stops[i].map((c, k) => c + (x - i) * (stops[i + 1][k] - c));
}

/** From where to where most values of a layer are. */
export function rangeOf(values) {
  const sample = [];
  for (let i = 0; i < values.length; i += Math.max(1, Math.floor(values.length / 20000))) {
    const value = floatOfHalf[values[i]];
    if (Number.isFinite(value)) sample.push(value);
  }
  sample.sort((a, b) => a - b);
  const low = sample[Math.floor(0.01 * sample.length)] ?? 0, high = sample[Math.floor(0.99 * (sample.length - 1))] ?? 1;
  return high > low ? [low, high] : [low, low + 1];
}

/** Fills the bytes of an ImageData with a layer of halves; the range of its false colours, or null for colours. */
export function paint(bytes, { halves, channels }, { exposure, tone, isColour }) {
  const count = bytes.length / 4;
  if (channels === 3) {
    const table = toneTable(isColour ? exposure : 0, isColour ? tone : "srgb");
    for (let i = 0, h = 0, b = 0; i < count; ++i, b += 4) {
      bytes[b] = table[halves[h++]];
      bytes[b + 1] = table[halves[h++]];
      bytes[b + 2] = table[halves[h++]];
      bytes[b + 3] = 255;
    }
    return null;
  }
  const range = rangeOf(halves);
  paintNumbers(bytes, (i) => floatOfHalf[halves[i * channels]], range);
  return range;
}

/** Fills the bytes with the false colours of numbers. */
export function paintNumbers(bytes, numberAt, [low, high]) {
  const table = Array.from({ length: 256 }, (_, i) => falseColour(i / 255));
  for (let i = 0, b = 0; b < bytes.length; ++i, b += 4) {
    const place = Math.round((255 * (numberAt(i) - low)) / (high - low));
    const [red, green, blue] = table[Math.min(Math.max(place, 0), 255)] ?? table[255];
    bytes[b] = red;
    bytes[b + 1] = green;
    bytes[b + 2] = blue;
    bytes[b + 3] = 255;
  }
}
