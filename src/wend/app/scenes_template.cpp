#include <wend/app/scenes_template.h>

namespace wend {

const std::string_view scenes_template = R"html(<a class="skip" href="#main">To the results</a>
<header>
<p class="kicker">Wend</p>
<h1>{{title}}</h1>
{{note}}</header>
<main id="main">

{{failed}}<section>
<h2>Gains</h2>
<div class="scroll" tabindex="0" role="region" aria-label="Gains of each way of sampling">
<table>
<thead><tr><th scope="col">sampling</th><th scope="col">geometric mean</th><th scope="col">worst</th><th scope="col">10&nbsp;%</th><th scope="col">25&nbsp;%</th><th scope="col">median</th><th scope="col">75&nbsp;%</th><th scope="col">90&nbsp;%</th><th scope="col">best</th><th scope="col">below&nbsp;1</th></tr></thead>
<tbody>
{{gains}}</tbody>
</table>
</div>
<p class="note"><b>Gain</b> is relMSE&nbsp;×&nbsp;seconds of classical sampling over that of the row: how many times faster the same error is reached. <b>×/÷</b> is the standard error of the geometric mean over the scenes, as a factor. Columns in per cent are quantiles: so many of the scenes gain less.</p>
{{plot}}</section>

<section>
<h2>Worst first</h2>
<div class="scroll" tabindex="0" role="region" aria-label="Every scene and way of sampling, the worst gain first">
<table>
<thead><tr><th scope="col">scene</th><th class="left" scope="col">sampling</th><th scope="col">gain</th><th scope="col">by seed</th><th scope="col">relMSE</th><th scope="col">relMSE, trimmed</th><th scope="col">spp</th><th scope="col">seconds</th></tr></thead>
<tbody>
{{cases}}</tbody>
</table>
</div>
</section>

{{scenes}}<section>
<h2>Settings</h2>
<dl>
{{settings}}</dl>
<p class="note">The numbers of this page and more: <a href="comparison.json">comparison.json</a>, <a href="rows.csv">rows.csv</a>, <a href="runs.csv">runs.csv</a>, <a href="curves.csv">curves.csv</a>.</p>
</section>

</main>
)html";

const std::string_view scenes_style = R"css(
a { color: var(--accent); }
.skip { position: absolute; left: -100rem; }
.skip:focus { left: 1rem; top: 1rem; padding: .4rem .8rem; border-radius: .3rem; background: var(--panel); }
th.left, td.left { text-align: left; }
.loss { color: #b5480a; font-weight: 600; }
@media (prefers-color-scheme: dark) { .loss { color: #f0935a; } }
section > .plot { max-width: none; margin-top: 1.5rem; }
.failed { padding: 1rem 1.25rem; border: 1px solid var(--rule); border-left: 4px solid #d65f10; border-radius: .3rem; background: var(--panel); }
.failed ul { margin: 0; padding-left: 1.1rem; overflow-wrap: anywhere; }
.case { display: grid; gap: 1rem 2rem; grid-template-columns: minmax(0, 16rem) minmax(0, 1fr); align-items: start; }
.case img { display: block; width: 100%; border-radius: .3rem; }
.case h2 { grid-column: 1 / -1; margin: 0; overflow-wrap: anywhere; }
.case > div, .case > details { grid-column: 2; min-width: 0; }
.case figure { grid-row: 2 / span 2; }
summary { cursor: pointer; color: var(--quiet); }
@media (max-width: 40rem) {
  .case { grid-template-columns: minmax(0, 1fr); }
  .case > div, .case > details { grid-column: 1; }
  .case figure { grid-row: auto; }
}
)css";

}  // namespace wend
