// What the guide knows where a pixel looks: a sphere of its lobes beside that of the records, and the cells around.
import { falseColour } from "./colours.js";
import { plotFlight } from "./plots.js";

const DECADES = 4;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const byId = (id) => document.getElementById(id);
const number = (x, digits = 3) => (x === null ? "∞" : Number(x.toPrecision(digits)).toString());

/** A von Mises–Fisher density by direction. */
function densityOf({ mean, kappa, weight }) {
  const scale = kappa < 1e-3 ? 1 / (4 * Math.PI) : kappa / (2 * Math.PI * (1 - Math.exp(-2 * kappa)));
  return (w) => weight * scale * Math.exp(kappa * (dot(mean, w) - 1));
}

export class GuideView {
  constructor(onDistance) {
    this.sphere = byId("sphere");
    this.seen = byId("seen");
    this.distance = byId("distance");
    this.report = null;
    this.distance.addEventListener("change", () => onDistance((this.distance.value / 1000) * this.report.flight.length));
    for (const canvas of [this.sphere, this.seen]) this.listen(canvas);
  }

  listen(canvas) {
    let from = null;
    canvas.addEventListener("pointerdown", (event) => {
      from = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!from) return;
      this.turn((event.clientX - from[0]) / 80, (event.clientY - from[1]) / 80);
      from = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointerup", () => (from = null));
    const keys = { ArrowLeft: [-0.2, 0], ArrowRight: [0.2, 0], ArrowUp: [0, -0.2], ArrowDown: [0, 0.2] };
    canvas.addEventListener("keydown", (event) => {
      if (!keys[event.key]) return;
      event.preventDefault();
      this.turn(...keys[event.key]);
    });
  }

  /** The eye's frame: right, up, and towards the eye. It begins as the camera looks. */
  turn(right, down) {
    let { x, y, z } = this.frame;
    const mix = (a, b, angle) => unit(a.map((v, i) => v * Math.cos(angle) + b[i] * Math.sin(angle)));
    z = mix(z, x, -right);
    x = unit(cross(y, z));
    z = mix(z, y, down);
    y = unit(cross(z, x));
    this.frame = { x, y, z };
    this.draw();
  }

  show(report) {
    const isNew = !this.report || report.segment.direction.join() !== this.report.segment.direction.join();
    this.report = report;
    if (isNew) {
      const z = report.segment.direction.map((c) => -c), up = Math.abs(z[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0];
      const x = unit(cross(up, z));
      this.frame = { x, y: cross(z, x), z };
    }
    this.showWords();
    this.showFlight();
    this.showLobes();
    this.draw();
  }

  showWords() {
    const { segment, at } = this.report;
    const end = { surface: "a surface", interface: "the boundary of a medium", nothing: "nothing" }[segment.end];
    let text = segment.length === null ? `The pixel's ray meets ${end}` : `The pixel's ray meets ${end} after ${number(segment.length)}`;
    text += segment.in_medium ? ", through a medium. " : ". ";
    if (at) text += `Below: at distance ${number(at.distance)}, (${at.position.map((x) => number(x)).join(", ")}), ${at.part === "surface" ? "on the surface" : "in the medium"}.`;
    byId("where").textContent = text;
  }

  showFlight() {
    const { flight, at } = this.report;
    byId("flight").hidden = !flight;
    if (!flight) return;
    plotFlight(byId("flight-plot"), flight, at?.distance ?? null);
    const share = (ends) => `${(100 * ends.scatters).toFixed(0)} % scatter`;
    byId("flight-guided").hidden = !flight.guided;
    if (flight.guided) byId("guided-share").textContent = `guided: ${share(flight.guided)}`;
    byId("classical-share").textContent = `classical: ${share(flight.classical)}`;
    this.distance.value = at ? Math.round((1000 * Math.min(at.distance, flight.length)) / flight.length) : 1000;
    byId("distance-value").value = at ? number(at.distance) : "";
  }

  showLobes() {
    const { guide, cells } = this.report;
    byId("lobes").hidden = !guide;
    byId("cells").hidden = !cells;
    if (!guide) {
      byId("where").textContent += " Nothing has been learned there.";
      return;
    }
    const outside = guide.is_inside ? "" : " The point is outside of the field's bounds: the nearest cell answers.";
    byId("share").textContent = `Fluence ${number(guide.fluence)}; ${(100 * guide.classical_share).toFixed(0)} % of directions are drawn classically.${outside}`;
    byId("seen-caption").textContent = guide.records ? `what ${guide.records.count} records saw` : "no records are kept";
    const heads = ["share", "towards", "concentration", "distance"];
    const rows = guide.lobes.map(({ weight, mean, kappa, distance }) => [weight.toFixed(3), mean.map((x) => x.toFixed(2)).join(" "), number(kappa), distance === null ? "far" : number(distance)]);
    const row = (texts, name) => {
      const tr = document.createElement("tr");
      tr.append(...texts.map((text) => Object.assign(document.createElement(name), { textContent: text })));
      return tr;
    };
    byId("lobe-table").replaceChildren(row(heads, "th"), ...rows.map((texts) => row(texts, "td")));
  }

  draw() {
    const { guide } = this.report;
    if (guide) {
      const lobes = guide.lobes.map(densityOf);
      const radiance = (w) => guide.fluence * lobes.reduce((sum, lobe) => sum + lobe(w), 0);
      let largest = 1e-30;
      for (const { mean } of guide.lobes) largest = Math.max(largest, radiance(mean));
      this.drawSphere(this.sphere, radiance, largest);
      this.drawSphere(this.seen, this.recordsBy(guide.records), largest);
    }
    if (this.report.cells) this.drawCells();
  }

  recordsBy(records) {
    if (!records) return () => 0;
    const { around, down, radiance } = records;
    return ([x, y, z]) => {
      const column = Math.min(around - 1, Math.floor((Math.atan2(y, x) / (2 * Math.PI) + 0.5) * around));
      const row = Math.min(down - 1, Math.floor((Math.acos(Math.min(Math.max(z, -1), 1)) / Math.PI) * down));
      return radiance[row * around + column] ?? 0;
    };
  }

  drawSphere(canvas, radiance, largest) {
    const context = canvas.getContext("2d"), { width } = canvas, radius = width / 2 - 16;
    const image = context.createImageData(width, width), { x, y, z } = this.frame;
    for (let py = 0; py < width; ++py) {
      for (let px = 0; px < width; ++px) {
        const a = (px + 0.5 - width / 2) / radius, b = (width / 2 - py - 0.5) / radius, c = 1 - a * a - b * b;
        if (c < 0) continue;
        const w = [0, 1, 2].map((i) => a * x[i] + b * y[i] + Math.sqrt(c) * z[i]);
        const place = 1 + Math.log10(Math.max(radiance(w), 1e-30) / largest) / DECADES;
        image.data.set([...falseColour(place), 255], 4 * (py * width + px));
      }
    }
    context.putImageData(image, 0, 0);
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = getComputedStyle(canvas).color;
    [["x", 0], ["y", 1], ["z", 2]].forEach(([name, i]) => {
      if (z[i] < 0) return;
      context.fillText(name, width / 2 + x[i] * (radius + 8) - 3, width / 2 - y[i] * (radius + 8) + 4);
    });
  }

  drawCells() {
    const canvas = byId("cell-view"), context = canvas.getContext("2d"), { width, height } = canvas;
    const { cells, at, segment } = this.report, { x, y } = this.frame;
    context.clearRect(0, 0, width, height);
    const here = cells.nearest.find((cell) => cell.is_here) ?? cells.nearest[0];
    const scale = height / (5 * Math.max(...here.max.map((v, i) => v - here.min[i]), 1e-12));
    const project = (p) => {
      const d = p.map((v, i) => v - at.position[i]);
      return [width / 2 + scale * dot(d, x), height / 2 - scale * dot(d, y)];
    };
    const brightest = Math.max(...cells.nearest.map(({ fluence }) => fluence), 1e-30);
    for (const cell of [...cells.nearest].reverse()) {
      const corner = (bits) => project([0, 1, 2].map((i) => (bits & (1 << i) ? cell.max[i] : cell.min[i])));
      context.strokeStyle = `rgb(${falseColour(0.3 + 0.7 * (1 + Math.log10(Math.max(cell.fluence, 1e-30) / brightest) / DECADES)).join()})`;
      context.lineWidth = cell.is_here ? 3 : 1;
      context.beginPath();
      for (let from = 0; from < 8; ++from) {
        for (let axis = 0; axis < 3; ++axis) {
          if (from & (1 << axis)) continue;
          context.moveTo(...corner(from));
          context.lineTo(...corner(from | (1 << axis)));
        }
      }
      context.stroke();
    }
    context.strokeStyle = context.fillStyle = "#fff";
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(...project(segment.origin));
    context.lineTo(...project(at.position));
    context.stroke();
    context.beginPath();
    context.arc(width / 2, height / 2, 4, 0, 7);
    context.fill();
    byId("cell-text").textContent = `${cells.nearest.length} of ${cells.all} cells; brighter lines: more light; the thick one holds the point, ${number(here.records)} records taught it`;
  }
}
