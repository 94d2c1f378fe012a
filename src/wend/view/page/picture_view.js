// The picture on its stage: tones, zoom, a divider between two, their difference, and a cross on a pixel.
import { decode, paint, paintNumbers } from "./colours.js";

// From so many screen pixels a pixel on, its values are written into it.
const LARGE = 56;

const mean = ({ halves, channels }, i) => {
  let sum = 0;
  for (let c = 0; c < channels; ++c) sum += decode(halves[i * channels + c]);
  return sum / channels;
};

const valuesOf = ({ halves, channels }, i) => Array.from(halves.subarray(i * channels, (i + 1) * channels), decode);

/** Of a pixel's mean over channels, relative to both. */
function differenceOf(left, right, i) {
  const a = mean(left, i), b = mean(right, i);
  return Math.abs(a - b) / Math.max(1e-6, 0.5 * (Math.abs(a) + Math.abs(b)));
}

export class PictureView {
  constructor(stage, canvas, { onPixel, onChoose }) {
    this.stage = stage;
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.onPixel = onPixel;
    this.onChoose = onChoose;
    this.left = null;
    this.right = null;
    this.mode = "wipe";
    this.split = 0.5;
    this.tones = { exposure: 0, tone: "srgb", isColour: true };
    this.zoom = null; // screen pixels a pixel; null: as fits
    this.centre = [0.5, 0.5];
    this.cross = null;
    this.surfaces = new Map();
    this.listen();
    new ResizeObserver(() => this.draw()).observe(stage);
  }

  set(left, right) {
    this.left = left;
    this.right = right;
    this.surfaces.clear();
    this.draw();
  }

  setTones(tones) {
    this.tones = { ...this.tones, ...tones };
    this.surfaces.clear();
    this.draw();
  }

  /** The range of false colours, if these are shown. */
  get range() {
    return this.shownRange ?? null;
  }

  surface(key, width, height, fill) {
    if (!this.surfaces.has(key)) {
      const surface = document.createElement("canvas");
      surface.width = width;
      surface.height = height;
      const context = surface.getContext("2d"), image = context.createImageData(width, height);
      surface.range = fill(image.data) ?? null;
      context.putImageData(image, 0, 0);
      this.surfaces.set(key, surface);
    }
    return this.surfaces.get(key);
  }

  surfaceOf(side) {
    const layer = this[side];
    return this.surface(side, layer.width, layer.height, (bytes) => paint(bytes, layer, this.tones));
  }

  differenceSurface() {
    const { left, right } = this;
    return this.surface("difference", left.width, left.height, (bytes) => {
      const range = [0, 1];
      paintNumbers(bytes, (i) => differenceOf(left, right, i), range);
      return range;
    });
  }

  fit() {
    return Math.min(this.stage.clientWidth / this.left.width, this.stage.clientHeight / this.left.height);
  }

  /** Scale, and where the picture's corner is on the stage. */
  place() {
    const scale = this.zoom ?? this.fit();
    return {
      scale,
      x: this.stage.clientWidth / 2 - this.centre[0] * this.left.width * scale,
      y: this.stage.clientHeight / 2 - this.centre[1] * this.left.height * scale,
    };
  }

  canDiffer() {
    return this.right && this.left.width === this.right.width && this.left.height === this.right.height && this.left.channels === this.right.channels;
  }

  draw() {
    const ratio = devicePixelRatio, { clientWidth, clientHeight } = this.stage;
    this.canvas.width = clientWidth * ratio;
    this.canvas.height = clientHeight * ratio;
    if (!this.left) return;
    const { context } = this, { scale, x, y } = this.place();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.imageSmoothingEnabled = scale < 1;
    const drawSurface = (surface) => context.drawImage(surface, x, y, this.left.width * scale, this.left.height * scale);
    const differs = this.mode === "difference" && this.canDiffer();
    const shown = differs ? this.differenceSurface() : this.surfaceOf("left");
    drawSurface(shown);
    this.shownRange = shown.range;
    if (this.right && !differs) this.drawRight(drawSurface, x, scale);
    if (scale >= LARGE) this.drawValues(scale, x, y, differs);
    if (this.cross) this.drawCross(scale, x, y);
  }

  drawRight(drawSurface, x, scale) {
    const { context } = this, edge = x + this.split * this.left.width * scale, { clientWidth, clientHeight } = this.stage;
    context.save();
    context.beginPath();
    context.rect(edge, 0, clientWidth - edge, clientHeight);
    context.clip();
    context.clearRect(edge, 0, clientWidth - edge, clientHeight);
    drawSurface(this.surfaceOf("right"));
    context.restore();
    context.fillStyle = "#fff";
    context.fillRect(edge - 1, 0, 2, clientHeight);
  }

  /** What is written into a pixel: of the picture that its middle shows. */
  valuesAt(px, py, differs) {
    const { left, right } = this, i = py * left.width + px;
    if (differs) return [differenceOf(left, right, i)];
    if (!right || px + 0.5 < this.split * left.width) return valuesOf(left, i);
    const onRight = Math.floor(((py + 0.5) / left.height) * right.height) * right.width + Math.floor(((px + 0.5) / left.width) * right.width);
    return valuesOf(right, onRight);
  }

  drawValues(scale, x, y, differs) {
    const { context, left } = this;
    context.lineJoin = "round";
    context.font = `${Math.min(13, scale / 6)}px system-ui, sans-serif`;
    const first = [Math.max(0, Math.floor(-x / scale)), Math.max(0, Math.floor(-y / scale))];
    const last = [Math.min(left.width, Math.ceil((this.stage.clientWidth - x) / scale)), Math.min(left.height, Math.ceil((this.stage.clientHeight - y) / scale))];
    for (let py = first[1]; py < last[1]; ++py) {
      for (let px = first[0]; px < last[0]; ++px) {
        this.valuesAt(px, py, differs).forEach((value, c) => {
          const text = value.toPrecision(3), at = [x + (px + 0.08) * scale, y + (py + 0.3 + 0.25 * c) * scale];
          context.lineWidth = 3;
          context.strokeStyle = "#000";
          context.strokeText(text, ...at);
          context.fillStyle = "#fff";
          context.fillText(text, ...at);
        });
      }
    }
  }

  drawCross(scale, x, y) {
    const { context } = this, [px, py] = this.cross, size = Math.max(scale, 5);
    const at = [x + (px + 0.5) * scale - size / 2, y + (py + 0.5) * scale - size / 2];
    context.lineWidth = 3;
    context.strokeStyle = "#000";
    context.strokeRect(...at, size, size);
    context.lineWidth = 1.5;
    context.strokeStyle = "#fff";
    context.strokeRect(...at, size, size);
  }

  zoomBy(factor, anchor = [this.stage.clientWidth / 2, this.stage.clientHeight / 2]) {
    if (!this.left) return;
    const before = this.place(), scale = Math.min(Math.max(before.scale * factor, this.fit() / 2), 256);
    // The point under the anchor stays where it is.
    const at = [(anchor[0] - before.x) / before.scale, (anchor[1] - before.y) / before.scale];
    this.zoom = scale;
    this.centre = [
      (at[0] - (anchor[0] - this.stage.clientWidth / 2) / scale) / this.left.width,
      (at[1] - (anchor[1] - this.stage.clientHeight / 2) / scale) / this.left.height,
    ];
    this.draw();
  }

  zoomToFit() {
    this.zoom = null;
    this.centre = [0.5, 0.5];
    this.draw();
  }

  pixelAt(event) {
    if (!this.left) return null;
    const box = this.stage.getBoundingClientRect(), { scale, x, y } = this.place();
    const pixel = [Math.floor((event.clientX - box.left - x) / scale), Math.floor((event.clientY - box.top - y) / scale)];
    return pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < this.left.width && pixel[1] < this.left.height ? pixel : null;
  }

  moveCross(dx, dy) {
    if (!this.left) return;
    const [x, y] = this.cross ?? [Math.floor(this.left.width / 2), Math.floor(this.left.height / 2)];
    this.cross = [Math.min(Math.max(x + dx, 0), this.left.width - 1), Math.min(Math.max(y + dy, 0), this.left.height - 1)];
    this.draw();
    this.onPixel(this.cross);
  }

  choose(pixel) {
    this.cross = pixel;
    this.draw();
    this.onChoose(pixel);
  }

  listen() {
    let from = null, moved = false;
    this.stage.addEventListener("pointerdown", (event) => {
      from = [event.clientX, event.clientY];
      moved = false;
      this.stage.setPointerCapture(event.pointerId);
    });
    this.stage.addEventListener("pointermove", (event) => {
      if (!this.left) return;
      if (from && (moved || Math.hypot(event.clientX - from[0], event.clientY - from[1]) > 4)) {
        const { scale } = this.place();
        moved = true;
        this.zoom = scale;
        this.centre[0] -= (event.clientX - from[0]) / (scale * this.left.width);
        this.centre[1] -= (event.clientY - from[1]) / (scale * this.left.height);
        from = [event.clientX, event.clientY];
        this.draw();
      }
      const pixel = this.pixelAt(event);
      if (pixel) this.onPixel(pixel);
    });
    this.stage.addEventListener("pointerup", (event) => {
      const pixel = this.pixelAt(event);
      if (from && !moved && pixel) this.choose(pixel);
      from = null;
    });
    this.stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      const box = this.stage.getBoundingClientRect();
      this.zoomBy(2 ** (-event.deltaY / 200), [event.clientX - box.left, event.clientY - box.top]);
    }, { passive: false });
    const keys = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
    };
    this.stage.addEventListener("keydown", (event) => {
      const step = event.shiftKey ? 10 : 1;
      if (keys[event.key]) this.moveCross(keys[event.key][0] * step, keys[event.key][1] * step);
      else if (event.key === "Enter" && this.cross) this.choose(this.cross);
      else if (event.key === "+" || event.key === "=") this.zoomBy(2);
      else if (event.key === "-") this.zoomBy(0.5);
      else if (event.key === "0") this.zoomToFit();
      else return;
      event.preventDefault();
    });
  }
}
