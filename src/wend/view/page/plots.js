// Plots in SVG: noise over time, and where flights end.

const SVG = "http://www.w3.org/2000/svg";

function element(parent, name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

function canvasOf(parent, width, height, label) {
  parent.replaceChildren();
  return element(parent, "svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label });
}

const short = (x) => (x >= 100 || x === 0 ? x.toFixed(0) : x.toPrecision(2));

/** Relative noise over seconds, both in decades, a line for each picture. */
export function plotNoise(parent, pictures) {
  const lines = pictures.map(({ curve }) => curve.filter(([seconds, , noise]) => seconds > 0 && noise > 0));
  const points = lines.flat();
  if (points.length < 2) return false;
  const width = 370, height = 190, left = 44, right = 8, top = 20, bottom = 26;
  const range = (values) => {
    const low = Math.log10(Math.min(...values)), high = Math.log10(Math.max(...values));
    return high - low < 0.1 ? [low - 0.1, high + 0.1] : [low, high];
  };
  const x = range(points.map(([seconds]) => seconds)), y = range(points.map(([, , noise]) => noise));
  const toX = (seconds) => left + ((Math.log10(seconds) - x[0]) / (x[1] - x[0])) * (width - left - right);
  const toY = (noise) => top + ((y[1] - Math.log10(noise)) / (y[1] - y[0])) * (height - top - bottom);
  const svg = canvasOf(parent, width, height, `Relative noise over seconds: ${pictures.map((p, i) => `${p.name} ${short(lines[i].at(-1)?.[2] ?? 0)}`).join(", ")}`);
  element(svg, "path", { class: "axis", d: `M${left},${top}V${height - bottom}H${width - right}` });
  for (const [value, place] of [[10 ** y[0], height - bottom], [10 ** y[1], top + 8]]) {
    element(svg, "text", { x: left - 5, y: place, "text-anchor": "end" }, short(value));
  }
  element(svg, "text", { x: left, y: height - 10 }, `${short(10 ** x[0])} s`);
  element(svg, "text", { x: width - right, y: height - 10, "text-anchor": "end" }, `${short(10 ** x[1])} s`);
  lines.forEach((line, i) => {
    if (line.length === 0) return;
    element(svg, "path", { class: `line-${i % 4}`, d: line.map(([s, , n], k) => `${k ? "L" : "M"}${toX(s).toFixed(1)},${toY(n).toFixed(1)}`).join("") });
    const last = line.at(-1), [atX, atY] = [toX(last[0]), toY(last[2])], isLeft = atX < width / 2;
    element(svg, "circle", { class: `point-${i % 2}`, cx: atX, cy: atY, r: 2.5 });
    element(svg, "text", { x: isLeft ? atX + 6 : atX - 4, y: atY - 5, "text-anchor": isLeft ? "start" : "end" }, pictures[i].name);
  });
  return true;
}

// How much taller than the tallest classical bin a guided bar is drawn; what is higher is cut, with its count.
const TALLEST = 3;

/** Where flights of a pixel end: guided as bars, classical as a line. */
export function plotFlight(parent, flight, distance) {
  const width = 370, height = 120, left = 4, right = 4, top = 16, bottom = 18, bins = flight.classical.bins.length;
  const guided = flight.guided?.bins;
  const most = Math.max(1, Math.min(Math.max(...flight.classical.bins) * TALLEST, Math.max(...flight.classical.bins, ...(guided ?? []))));
  const toX = (bin) => left + (bin / bins) * (width - left - right);
  const toY = (count) => top + (1 - Math.min(count, most) / most) * (height - top - bottom);
  const percent = (ends) => `${(100 * ends.scatters).toFixed(0)} %`;
  const svg = canvasOf(parent, width, height,
    `Of classical flights ${percent(flight.classical)} scatter${flight.guided ? `, of guided ones ${percent(flight.guided)}` : ""}`);
  element(svg, "path", { class: "axis", d: `M${left},${height - bottom}H${width - right}` });
  guided?.forEach((count, i) => element(svg, "rect", { class: "guided", x: toX(i), y: toY(count), width: toX(1) - toX(0) - 0.5, height: height - bottom - toY(count) }));
  const highest = guided ? guided.indexOf(Math.max(...guided)) : -1;
  if (guided && guided[highest] > most) {
    const isRight = highest > bins / 2;
    element(svg, "text", { x: toX(highest + (isRight ? 1 : 0)), y: top - 5, "text-anchor": isRight ? "end" : "start" }, `${(guided[highest] / most).toFixed(1)} times as high`);
  }
  element(svg, "path", { class: "classical", d: flight.classical.bins.map((count, i) => `${i ? "L" : "M"}${toX(i)},${toY(count)}H${toX(i + 1)}`).join("") });
  if (distance !== null && distance <= flight.length) {
    const at = toX((distance / flight.length) * bins);
    element(svg, "path", { class: "here", d: `M${at},${top}V${height - bottom}` });
  }
  element(svg, "text", { x: left, y: height - 5 }, "0");
  element(svg, "text", { x: width - right, y: height - 5, "text-anchor": "end" }, short(flight.length));
}
