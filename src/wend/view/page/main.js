// The page: what is asked of the program, when, and where its answers go.
import { Connection } from "./connection.js";
import { GuideView } from "./guide_view.js";
import { PictureView } from "./picture_view.js";
import { plotNoise } from "./plots.js";

const byId = (id) => document.getElementById(id);
const controls = Object.fromEntries(["left", "right", "mode", "layer", "exposure", "tone", "split"].map((id) => [id, byId(id)]));
const NONE = "none";

let state = null;
let held = { left: null, right: null }; // the layers on the stage
let chosen = null; // pixel and distance that the guide is asked at
const connection = new Connection((isOpen) => {
  byId("status").textContent = isOpen ? "" : "The program has ended, or cannot be reached. What is here stays; a new start says a new address.";
  for (const control of byId("run").querySelectorAll("button, select")) control.disabled = !isOpen;
});
const guide = new GuideView((distance) => inspect({ ...chosen, distance }));
const view = new PictureView(byId("stage"), byId("canvas"), { onPixel: showValues, onChoose: ([x, y]) => inspect({ x, y }) });

const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
const duration = (seconds) => (seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")} min`);

/** Fills a select, and leaves what was chosen. */
function fill(select, options) {
  if ([...select.options].map((o) => `${o.value} ${o.text}`).join() === options.map(([value, text]) => `${value} ${text}`).join()) return;
  const before = select.value;
  select.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  if (options.some(([value]) => String(value) === before)) select.value = before;
}

function showState() {
  document.title = `${state.title} – Wend`;
  byId("title").textContent = state.title;
  const { pictures, can } = state, many = pictures.length > 1;
  const names = pictures.map(({ name }, i) => [i, name]);
  const wasSingle = controls.right.options.length === 0;
  fill(controls.left, names);
  fill(controls.right, [[NONE, "nothing"], ...names]);
  if (wasSingle && many) controls.right.value = 1;
  byId("right-label").hidden = !many;
  const hasRight = many && controls.right.value !== NONE;
  byId("mode-label").hidden = !hasRight;
  byId("split-label").hidden = !hasRight || controls.mode.value === "difference";
  fill(controls.layer, pictures[controls.left.value || 0].layers.map((layer) => [layer, layer]));
  byId("run-title").textContent = pictures.every(({ phase }) => phase === "file") ? "Pictures" : "Render";
  showBars(pictures);
  showActions(can, pictures);
  byId("note").textContent = state.note;
  byId("convergence").hidden = !plotNoise(byId("plot"), pictures);
}

function showBars(pictures) {
  const bars = byId("bars");
  while (bars.children.length < pictures.length) {
    const bar = Object.assign(document.createElement("div"), { className: "bar" });
    bar.append(document.createElement("p"), document.createElement("progress"));
    bar.firstChild.append(document.createElement("b"), document.createElement("span"));
    bars.append(bar);
  }
  pictures.forEach(({ name, phase, progress, kinds }, i) => {
    const [text, line] = bars.children[i].children;
    line.hidden = !progress.fraction;
    line.value = progress.fraction ?? 0;
    line.setAttribute("aria-label", `How far ${name} is`);
    text.children[0].textContent = name;
    const noise = progress.noise === null ? "" : `, noise ${(100 * progress.noise).toPrecision(2)} %`;
    const guided = kinds.length > 1 ? `, ${(100 * kinds.slice(1).reduce((sum, kind) => sum + kind.share, 0)).toFixed(0)} % of walks guided` : "";
    text.children[1].textContent = phase === "file" ? "" : `${phase}, ${progress.spp} spp in ${duration(progress.seconds ?? 0)}${noise}${guided}`;
  });
  const { phase, progress } = pictures[0];
  byId("status").textContent = phase === "file" ? "" : `${phase}${phase === "done" || phase === "paused" || !progress.left ? "" : `, ${duration(progress.left)} left`}`;
}

function showActions(can, pictures) {
  const isPaused = pictures.some(({ phase }) => phase === "paused"), isDone = pictures.every(({ phase }) => phase === "done");
  byId("pause").hidden = !can.includes("pause") || isPaused || isDone;
  byId("go-on").hidden = !can.includes("go_on") || !isPaused;
  byId("more").hidden = !can.includes("more_seconds");
  byId("save").hidden = !can.includes("save");
  byId("stop").hidden = !can.includes("stop") || isDone;
  byId("restart").hidden = !can.includes("restart");
  byId("restart-of-label").hidden = pictures.length < 2;
  fill(byId("restart-of"), pictures.map(({ name }, i) => [i, name]));
  fill(byId("restart-sampling"), state.samplings.map((name) => [name, name]));
}

async function command(question) {
  try {
    await connection.askJson(question);
  } catch (error) {
    byId("note").textContent = error.message;
  }
}

/** A side of the stage, if there is something newer. */
async function fetchSide(side) {
  const value = controls[side].value;
  if (value === NONE || value === "" || (side === "right" && state.pictures.length < 2)) {
    const changed = held[side] !== null;
    held[side] = null;
    return changed;
  }
  const of = Number(value), layer = controls.layer.value || "beauty", before = held[side];
  const isSame = before && before.of === of && before.layer === layer;
  const got = await connection.askPicture(of, layer, isSame ? before.version : 0);
  if (got) held[side] = got;
  else if (!isSame) held[side] = null;
  return got !== null || (!isSame && before !== null);
}

function showPictures() {
  byId("empty").hidden = held.left !== null;
  byId("empty").textContent = controls.layer.value === "beauty" ? "The first picture is on its way." : `The layer ${controls.layer.value} is on its way.`;
  view.tones.isColour = (held.left?.layer ?? "beauty") === "beauty" || held.left?.layer === "noisy";
  view.set(held.left, held.right);
  const range = view.range;
  byId("scale").hidden = range === null;
  if (range) byId("scale").textContent = view.mode === "difference" && held.right ? "Relative difference: dark 0, light 1 and more" : `${held.left.layer}: dark ${range[0].toPrecision(3)}, light ${range[1].toPrecision(3)}`;
}

let asked = null; // the pixel whose values are asked for
async function showValues(pixel) {
  if (asked) {
    asked = pixel;
    return;
  }
  for (asked = pixel; asked; ) {
    const [x, y] = asked;
    try {
      const { values } = await connection.askJson({ ask: "values", of: Number(controls.left.value), x, y });
      const text = values && Object.entries(values).map(([name, list]) => `${name} ${list.map((v) => (v === null ? "not a number" : Number(v.toPrecision(4)))).join(" ")}`).join(" · ");
      byId("values").textContent = `pixel ${x}, ${y}: ${text ?? "nothing yet"}`;
    } catch {
      byId("values").textContent = "";
    }
    asked = asked[0] === x && asked[1] === y ? null : asked;
  }
}

/** Asks the guide where a pixel looks. */
async function inspect(where) {
  chosen = where;
  showValues([where.x, where.y]);
  try {
    const { report } = await connection.askJson({ ask: "pixel", of: Number(controls.left.value), ...where });
    byId("guide").hidden = report === null;
    if (report) guide.show(report);
  } catch (error) {
    byId("note").textContent = error.message;
  }
}

async function run() {
  for (;;) {
    try {
      state = await connection.askJson({ ask: "state" });
      showState();
      const changed = [await fetchSide("left"), await fetchSide("right")];
      if (changed.some(Boolean)) showPictures();
    } catch {
      // The connection says so itself.
    }
    await sleep(document.hidden ? 2000 : 250);
  }
}

controls.exposure.addEventListener("input", () => {
  byId("exposure-value").value = `${controls.exposure.value} EV`;
  view.setTones({ exposure: Number(controls.exposure.value) });
});
controls.tone.addEventListener("change", () => view.setTones({ tone: controls.tone.value }));
controls.split.addEventListener("input", () => {
  view.split = controls.split.value / 100;
  view.draw();
});
controls.mode.addEventListener("change", () => {
  view.mode = controls.mode.value;
  byId("split-label").hidden = view.mode === "difference";
  showPictures();
});
byId("zoom-in").addEventListener("click", () => view.zoomBy(2));
byId("zoom-out").addEventListener("click", () => view.zoomBy(0.5));
byId("zoom-fit").addEventListener("click", () => view.zoomToFit());
byId("pause").addEventListener("click", () => command({ ask: "pause" }));
byId("go-on").addEventListener("click", () => command({ ask: "go_on" }));
byId("more").addEventListener("click", () => command({ ask: "more_seconds", seconds: 60 }));
byId("save").addEventListener("click", () => command({ ask: "save" }));
byId("stop").addEventListener("click", () => command({ ask: "stop" }));
byId("restart").addEventListener("submit", (event) => {
  event.preventDefault();
  command({ ask: "restart", of: Number(byId("restart-of").value), sampling: byId("restart-sampling").value });
});
byId("stage").addEventListener("keydown", ({ key }) => {
  if (key !== "[" && key !== "]") return;
  controls.exposure.value = Number(controls.exposure.value) + (key === "]" ? 0.5 : -0.5);
  controls.exposure.dispatchEvent(new Event("input"));
});
run();
