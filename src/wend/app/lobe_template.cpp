#include <wend/app/lobe_template.h>

namespace wend {

const std::string_view lobe_template = R"html(<header>
<p class="kicker">Wend</p>
<h1>{{title}}</h1>
<p class="scene">{{file}}</p>
</header>
<main>

<section id="turn" aria-label="Sphere of directions" hidden>
<div class="globe">
<div>
<canvas id="sphere" width="420" height="420" tabindex="0" role="img" aria-label="Sphere of directions: each point is a direction that light comes from. Arrow keys turn it, Home faces the strongest lobe." aria-describedby="readout"></canvas>
<div class="scale"><span>radiance, logarithmic scale</span><span class="bar"><span>{{low}}</span><i></i><span>{{high}}</span></span></div>
</div>
<div class="side">
<label class="choice">Place <select id="place">{{options}}</select></label>
<p id="readout" aria-live="polite"></p>
<div class="faces" role="group" aria-label="Face an axis">
<button type="button" data-axis="1,0,0">+x</button><button type="button" data-axis="0,1,0">+y</button><button type="button" data-axis="0,0,1">+z</button>
<button type="button" data-axis="-1,0,0">−x</button><button type="button" data-axis="0,-1,0">−y</button><button type="button" data-axis="0,0,-1">−z</button>
</div>
<p class="note">Each point of the sphere is a direction that light comes from, seen from outside. Drag to turn it, or focus it and use the arrow keys; Home faces the strongest lobe. Crosses are the means of lobes, by number.</p>
</div>
</div>
</section>

{{flight}}{{places}}</main>
<script type="application/json" id="data">{{data}}</script>
<script>{{script}}</script>
)html";

const std::string_view lobe_style = R"css(
#turn { margin-top: 0; }
.globe { display: grid; gap: 1.5rem 2.5rem; grid-template-columns: minmax(0, 26rem) minmax(0, 1fr); align-items: start; }
#sphere { display: block; width: 100%; height: auto; cursor: grab; touch-action: none; }
dl dd { white-space: nowrap; }
.choice { display: block; color: var(--quiet); font-size: .875rem; }
.choice select { width: 100%; max-width: none; margin-top: .25rem; }
#readout { min-height: 8.5em; margin: 1rem 0; font-variant-numeric: tabular-nums; white-space: pre-line; }
.faces { display: grid; gap: .4rem; grid-template-columns: repeat(3, minmax(3rem, 5rem)); }
button { padding: .4rem .6rem; border: 1px solid var(--rule); border-radius: .4rem; background: var(--panel); color: var(--ink); font: inherit; font-size: .875rem; cursor: pointer; }
.warning { padding: .6rem .9rem; border-left: 4px solid #d65f10; border-radius: .3rem; background: var(--panel); }
.map { margin: 0 0 1.25rem; }
.map img { width: 100%; max-width: 47rem; height: auto; }
.face { display: none; }
.scripted .face { display: inline-block; padding: .1rem .6rem; }
@media (max-width: 48rem) { .globe { grid-template-columns: minmax(0, 1fr); } #readout { min-height: 0; } }
)css";

const std::string_view lobe_script = R"js(
"use strict";
{
  const find = (id) => document.getElementById(id);
  const data = JSON.parse(find("data").textContent);
  const canvas = find("sphere");
  const context = canvas.getContext("2d");
  const size = canvas.width, radius = size / 2 - 2;
  const colours = data.colours.map((c) => [1, 3, 5].map((i) => parseInt(c.slice(i, i + 2), 16)));
  let shown = data.places[0];
  // The viewer is at this longitude, and at this height above the plane of x and y, in radians.
  let longitude = 0, height = 0;

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const frame = () => {
    const [cl, sl, ch, sh] = [Math.cos(longitude), Math.sin(longitude), Math.cos(height), Math.sin(height)];
    return {out: [ch * cl, ch * sl, sh], right: [-sl, cl, 0], up: [-sh * cl, -sh * sl, ch]};
  };
  const peak = (k) => (k > 1e-3 ? k / (2 * Math.PI * (1 - Math.exp(-2 * k))) : 1 / (4 * Math.PI));
  /// Of a lobe what a loop over pixels needs.
  const plain = (lobe) => [...lobe.mean, lobe.kappa, shown.fluence * lobe.weight * peak(lobe.kappa)];
  const part = (l, x, y, z) => l[4] * Math.exp(l[3] * (l[0] * x + l[1] * y + l[2] * z - 1));

  const direction_at = (x, y) => {
    const u = (x - size / 2) / radius, v = (size / 2 - y) / radius, rest = 1 - u * u - v * v;
    if (rest < 0) return null;
    const f = frame(), s = Math.sqrt(rest);
    return [0, 1, 2].map((i) => u * f.right[i] + v * f.up[i] + s * f.out[i]);
  };

  const mark = (w, text, cross) => {
    const f = frame();
    if (dot(w, f.out) < 0) return;
    const x = size / 2 + radius * dot(w, f.right), y = size / 2 - radius * dot(w, f.up);
    context.lineWidth = 2;
    context.strokeStyle = "#fff";
    context.beginPath();
    if (cross) {
      context.moveTo(x - 5, y); context.lineTo(x + 5, y); context.moveTo(x, y - 5); context.lineTo(x, y + 5);
    } else {
      context.arc(x, y, 4, 0, 7);
    }
    context.stroke();
    context.font = "600 13px system-ui, sans-serif";
    context.lineWidth = 3;
    context.strokeStyle = "#000a";
    context.fillStyle = "#fff";
    const left = x > size - 60 ? x - 10 - context.measureText(text).width : x + 8;
    const above = y < 24 ? y + 18 : y - 6;
    context.strokeText(text, left, above);
    context.fillText(text, left, above);
  };

  const draw = (coarse) => {
    const step = coarse ? 3 : 1, pixels = context.createImageData(size, size);
    const lobes = shown.lobes.map(plain), f = frame(), most = colours.length - 1;
    const stretch = most / Math.log(data.high / data.low);
    for (let y = 0; y < size; y += step) {
      for (let x = 0; x < size; x += step) {
        const u = (x + step / 2 - size / 2) / radius, v = (size / 2 - y - step / 2) / radius, rest = 1 - u * u - v * v;
        if (rest < 0) continue;
        const s = Math.sqrt(rest);
        const wx = u * f.right[0] + v * f.up[0] + s * f.out[0], wy = u * f.right[1] + v * f.up[1] + s * f.out[1];
        const wz = u * f.right[2] + v * f.up[2] + s * f.out[2];
        let radiance = 0;
        for (const lobe of lobes) radiance += part(lobe, wx, wy, wz);
        const at = stretch * Math.log(radiance / data.low);
        const colour = colours[Math.max(0, Math.min(most, Math.round(at)))];
        for (let j = y; j < Math.min(size, y + step); ++j) {
          for (let i = x; i < Math.min(size, x + step); ++i) {
            const to = 4 * (j * size + i);
            pixels.data[to] = colour[0];
            pixels.data[to + 1] = colour[1];
            pixels.data[to + 2] = colour[2];
            pixels.data[to + 3] = 255;
          }
        }
      }
    }
    context.putImageData(pixels, 0, 0);
    for (const [w, name] of [[[1, 0, 0], "+x"], [[0, 1, 0], "+y"], [[0, 0, 1], "+z"],
                             [[-1, 0, 0], "−x"], [[0, -1, 0], "−y"], [[0, 0, -1], "−z"]]) mark(w, name, false);
    for (const extra of shown.marks) mark(extra.direction, extra.name, false);
    shown.lobes.forEach((lobe, i) => mark(lobe.mean, String(i + 1), true));
  };

  const number = (value) => Number(value).toPrecision(3);
  const read = (w) => {
    const shares = shown.lobes.map((lobe) => part(plain(lobe), ...w));
    const all = shares.reduce((sum, one) => sum + one, 0);
    const most = shares.indexOf(Math.max(...shares));
    const degrees = (angle) => (angle * 180 / Math.PI).toFixed(1) + "°";
    find("readout").textContent = `radiance ${number(all)}\n` +
      `from direction ${w.map((c) => c.toFixed(3)).join("  ")}\n` +
      `longitude ${degrees(Math.atan2(w[1], w[0]))}, ${degrees(Math.acos(Math.max(-1, Math.min(1, w[2]))))} from +z\n` +
      (all > 0 ? `lobe ${most + 1} has ${(100 * shares[most] / all).toFixed(0)} % of it` : "");
  };
  const face = (w) => {
    height = Math.asin(Math.max(-1, Math.min(1, w[2])));
    if (Math.hypot(w[0], w[1]) > 1e-6) longitude = Math.atan2(w[1], w[0]);
    draw(false);
    read(frame().out);
  };
  const strongest = () => shown.lobes.reduce((a, b) => (b.weight > a.weight ? b : a)).mean;
  const turn = (right, up, coarse) => {
    longitude += right;
    height = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, height + up));
    draw(coarse);
  };
  const show = (index) => {
    shown = data.places[index];
    find("place").value = index;
    document.querySelectorAll("[data-section]").forEach((one) => { one.hidden = one.dataset.section !== String(index); });
    face(strongest());
  };

  const place_of = (event) => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * size / box.width, (event.clientY - box.top) * size / box.height];
  };
  let last = null;
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); last = place_of(event); });
  canvas.addEventListener("pointermove", (event) => {
    const now = place_of(event);
    if (last) {
      turn((last[0] - now[0]) / radius, (now[1] - last[1]) / radius, true);
      last = now;
    }
    const w = direction_at(...now);
    if (w) read(w);
  });
  const rest = () => { if (last) { last = null; draw(false); } };
  canvas.addEventListener("pointerup", rest);
  canvas.addEventListener("pointercancel", rest);
  canvas.addEventListener("keydown", (event) => {
    const step = Math.PI / 36;
    const turns = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
    if (turns[event.key]) turn(...turns[event.key], false);
    else if (event.key === "Home") face(strongest());
    else return;
    event.preventDefault();
    read(frame().out);
  });
  find("place").addEventListener("change", () => show(Number(find("place").value)));
  for (const button of document.querySelectorAll("[data-axis]")) {
    button.addEventListener("click", () => face(button.dataset.axis.split(",").map(Number)));
  }
  for (const button of document.querySelectorAll("[data-lobe]")) {
    button.addEventListener("click", () => {
      face(shown.lobes[Number(button.dataset.lobe)].mean);
      canvas.scrollIntoView({block: "nearest"});
    });
  }
  document.body.classList.add("scripted");
  find("turn").hidden = false;
  show(0);
}
)js";

}  // namespace wend
