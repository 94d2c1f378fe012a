#include <wend/app/report_template.h>

namespace wend {

const std::string_view report_template = R"html(<header>
<p class="kicker">Wend</p>
<h1>{{title}}</h1>
<p class="scene">{{scene}}</p>
</header>
<main>

<section id="compare" aria-label="Compare two pictures" hidden>
<div class="controls">
<label>Left <select id="left">{{left_options}}</select></label>
<fieldset>
<legend>Show</legend>
<label><input type="radio" name="view" value="0" checked><span>Pictures</span></label>
{{views}}</fieldset>
<label>Right <select id="right">{{right_options}}</select></label>
</div>
<div id="stage">
<img id="under" alt="" draggable="false">
<img id="over" alt="" draggable="false">
<span id="divider" aria-hidden="true"></span>
<span class="badge at-left" id="left-name"></span>
<span class="badge at-right" id="right-name"></span>
</div>
<input id="split" type="range" min="0" max="100" step="0.5" value="50" aria-label="Position of the divider">
<div id="legend" hidden></div>
</section>

<section id="view-0">
<h2>Pictures</h2>
<div class="strip">
{{pictures}}</div>
</section>

<section>
<h2>Results</h2>
<div class="scroll" tabindex="0" role="region" aria-label="Table of results">
<table>
<thead><tr><th scope="col">sampling</th><th scope="col">relMSE</th><th scope="col">ratio</th><th scope="col">seconds</th><th scope="col">spp</th><th scope="col">relMSE, trimmed</th><th scope="col">99.99&nbsp;%</th><th scope="col">MSE</th><th scope="col">FLIP</th></tr></thead>
<tbody>
{{rows}}</tbody>
</table>
</div>
<p class="note"><b>relMSE</b> is the mean squared error relative to the squared reference; <b>trimmed</b> leaves out the worst 0.1&nbsp;% of pixels; <b>99.99&nbsp;%</b> of the pixels of all runs have a relative squared error of at most so much, and fireflies have more. <b>ratio</b> is relMSE&nbsp;×&nbsp;seconds of classical sampling over that of the row: how many times faster the row reaches the same error.</p>
</section>

{{spread}}<section>
<h2>Convergence</h2>
{{convergence}}</section>

{{maps}}<section>
<h2>Settings</h2>
<dl>
{{settings}}</dl>
</section>

</main>
<script>{{script}}</script>
)html";

const std::string_view report_spread = R"html(<section>
<h2>Spread over seeds</h2>
<div class="scroll" tabindex="0" role="region" aria-label="Spread over seeds">
<table>
<thead><tr><th scope="col">sampling</th><th scope="col">median relMSE</th><th scope="col">least</th><th scope="col">most</th><th scope="col">mean</th><th scope="col">standard error</th><th scope="col">least ratio</th><th scope="col">most</th></tr></thead>
<tbody>
{{rows}}</tbody>
</table>
</div>
<p class="note">Ratios are those of the renders that took the same turn. The standard error is that of the mean.</p>
</section>

)html";

const std::string_view report_style = R"css(
:root {
  --ground: #fbfaf7; --ink: #1d2126; --quiet: #5d646d; --rule: #dcd9d1; --panel: #f1efe9; --accent: #0067a8;
}
@media (prefers-color-scheme: dark) {
  :root { --ground: #14171a; --ink: #e6e4df; --quiet: #9ba2aa; --rule: #30353b; --panel: #1d2125; --accent: #5db4ee; }
}
* { box-sizing: border-box; }
body {
  margin: 0 auto; padding: clamp(1rem, 4vw, 3rem); max-width: 64rem;
  background: var(--ground); color: var(--ink);
  font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif;
}
h1, h2 { font-family: Charter, "Iowan Old Style", "Palatino Linotype", Palatino, Georgia, serif; font-weight: 600; line-height: 1.15; text-wrap: balance; }
h1 { margin: 0; font-size: clamp(1.7rem, 5vw, 2.6rem); letter-spacing: -0.01em; overflow-wrap: anywhere; }
h2 { margin: 0 0 1rem; font-size: 1.35rem; }
header { margin-bottom: 2rem; }
section { margin-top: 3rem; }
#compare { margin-top: 0; }
.kicker { margin: 0 0 .4rem; color: var(--accent); font-size: .8rem; font-weight: 600; letter-spacing: .14em; text-transform: uppercase; }
.scene { margin: .4rem 0 0; color: var(--quiet); overflow-wrap: anywhere; }
.note { max-width: 44rem; color: var(--quiet); font-size: .875rem; }
.note b { color: var(--ink); font-weight: 600; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }

.controls { display: flex; flex-wrap: wrap; gap: .75rem 1.25rem; align-items: center; justify-content: space-between; margin-bottom: .75rem; }
.controls > label { display: flex; gap: .5rem; align-items: center; min-width: 0; color: var(--quiet); font-size: .875rem; }
select {
  min-width: 0; max-width: 15rem; padding: .45rem .6rem; border: 1px solid var(--rule); border-radius: .4rem;
  background: var(--panel); color: var(--ink); font: inherit;
}
fieldset { display: flex; flex-wrap: wrap; min-width: 0; max-width: 100%; margin: 0; padding: 0; border: 1px solid var(--rule); border-radius: .4rem; }
legend { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
fieldset input { position: absolute; opacity: 0; }
fieldset span { display: block; padding: .45rem .8rem; border-radius: .35rem; color: var(--quiet); font-size: .875rem; cursor: pointer; }
fieldset input:checked + span { background: var(--accent); color: var(--ground); }
fieldset input:focus-visible + span { outline: 2px solid var(--accent); outline-offset: 2px; }

#stage {
  --split: 50%;
  position: relative; overflow: hidden; border-radius: .4rem; background: #000;
  cursor: ew-resize; touch-action: pan-y; user-select: none; -webkit-user-select: none;
}
#stage img, .strip img { display: block; width: 100%; image-rendering: pixelated; }
#over { position: absolute; inset: 0; height: 100%; clip-path: inset(0 calc(100% - var(--split)) 0 0); }
#divider { position: absolute; top: 0; bottom: 0; left: var(--split); width: 2px; margin-left: -1px; background: #fff; box-shadow: 0 0 4px #000a; }
#divider::after {
  content: "◂ ▸"; position: absolute; top: 50%; left: 50%; width: 2.5rem; transform: translate(-50%, -50%);
  border-radius: 1.25rem; background: #fff; color: #222; font-size: .8rem; line-height: 2.5rem; text-align: center; box-shadow: 0 1px 6px #0008;
}
.badge {
  position: absolute; bottom: .6rem; max-width: 45%; padding: .15rem .55rem; overflow: hidden; border-radius: .3rem;
  background: #000a; color: #fff; font-size: .8rem; text-overflow: ellipsis; white-space: nowrap; pointer-events: none;
}
.at-left { left: .6rem; }
.at-right { right: .6rem; }
#split { display: block; width: 100%; margin: .75rem 0 0; accent-color: var(--accent); }

.scale { display: flex; flex-wrap: wrap; gap: .25rem 1rem; justify-content: space-between; margin-top: .5rem; color: var(--quiet); font-size: .875rem; }
.bar { display: flex; flex: 0 1 22rem; gap: .5rem; align-items: center; font-variant-numeric: tabular-nums; }
.bar i { flex: 1; min-width: 6rem; height: .7rem; border-radius: .2rem; }

.scroll { overflow-x: auto; }
table { width: 100%; border-collapse: separate; border-spacing: 0; font-variant-numeric: tabular-nums; }
th, td { padding: .5rem .75rem; border-bottom: 1px solid var(--rule); text-align: right; white-space: nowrap; }
th:first-child { position: sticky; left: 0; padding-left: 0; background: var(--ground); text-align: left; }
td:last-child, th:last-child { padding-right: 0; }
thead th { color: var(--quiet); font-size: .8rem; font-weight: 500; }
tbody th { font-weight: 500; }
.role { color: var(--quiet); font-size: .8rem; font-weight: 400; }
.best th, .best td { font-weight: 700; }
.best .ratio { color: var(--accent); }

.plot { display: block; max-width: 100%; height: auto; margin: 0 auto; color: inherit; }
section > .plot, details > .plot { width: 100%; max-width: 46rem; }

summary { margin-top: .75rem; color: var(--quiet); cursor: pointer; }

.strip { display: grid; gap: 1.5rem 1rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 13rem), 1fr)); }
figure { margin: 0; }
figure img { border-radius: .3rem; }
figcaption { margin-top: .4rem; color: var(--quiet); font-size: .875rem; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
figcaption b { display: block; color: var(--ink); font-weight: 600; }
.scale + .strip { margin-top: 1rem; }

dl { display: grid; gap: .25rem 2rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 18rem), 1fr)); margin: 0; font-size: .9rem; }
dl div { display: flex; gap: 1rem; justify-content: space-between; padding: .3rem 0; border-bottom: 1px solid var(--rule); }
dt { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; text-align: right; font-variant-numeric: tabular-nums; }

@media (max-width: 40rem) {
  .controls { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); }
  .controls > label { flex-direction: column; gap: .2rem; align-items: stretch; }
  .controls fieldset { grid-row: 2; grid-column: 1 / -1; justify-self: center; }
  select { max-width: none; }
  th, td { padding: .45rem .5rem; }
  section .plot text { font-size: 16px; }
}
)css";

const std::string_view report_script = R"js(
"use strict";
{
  const find = (id) => document.getElementById(id);
  const image = (view, picture) => document.querySelector(`#view-${view} [data-picture="${picture}"] img`);
  const stage = find("stage");
  const split = find("split");

  const show = (view, picture, shown, badge) => {
    const chosen = image(view, picture) || image(0, picture);
    shown.src = chosen.src;
    shown.alt = chosen.alt;
    badge.textContent = chosen.alt;
  };

  const update = () => {
    const view = document.querySelector("input[name=view]:checked").value;
    const scale = document.querySelector(`#view-${view} .scale`);
    show(view, find("left").value, find("over"), find("left-name"));
    show(view, find("right").value, find("under"), find("right-name"));
    find("legend").hidden = !scale;
    find("legend").innerHTML = scale ? scale.outerHTML : "";
  };

  const place = () => stage.style.setProperty("--split", split.value + "%");

  const drag = (event) => {
    const box = stage.getBoundingClientRect();
    split.value = 100 * (event.clientX - box.left) / box.width;
    place();
  };

  stage.addEventListener("pointerdown", (event) => {
    stage.setPointerCapture(event.pointerId);
    drag(event);
  });
  stage.addEventListener("pointermove", (event) => {
    if (stage.hasPointerCapture(event.pointerId)) drag(event);
  });
  split.addEventListener("input", place);
  for (const control of document.querySelectorAll(".controls select, .controls input")) {
    control.addEventListener("change", update);
  }

  if (image(0, 1)) {
    find("compare").hidden = false;
    update();
    place();
  }
}
)js";

}  // namespace wend
