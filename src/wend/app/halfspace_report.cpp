#include <wend/app/halfspace_report.h>

#include <wend/app/halfspace_figures.h>
#include <wend/app/halfspace_table.h>
#include <wend/app/markup.h>
#include <wend/app/page_frame.h>
#include <wend/app/planar_options.h>
#include <wend/app/planar_report.h>
#include <wend/app/progress.h>
#include <wend/app/report_folder.h>
#include <wend/app/text_table.h>
#include <wend/io/atomic_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <ostream>

namespace wend {
namespace {

// The albedos at which the histograms and the walks are shown.
constexpr double histogram_albedo = 0.8, walks_albedo = 0.95;
constexpr int drawn_walks = 12;

struct Figure {
    std::string file;
    std::string caption;
    std::string svg;
};

PlanarExperiment with_sampler(PlanarExperiment experiment, const std::string& sampler, double albedo) {
    experiment.sampler = sampler;
    experiment.albedo = {albedo};
    return experiment;
}

std::vector<Figure> figures(const PlanarExperiment& base, const PlanarRun& run, const std::vector<HalfspaceRow>& rows) {
    std::vector<NamedHistogram> histograms;
    for (const char* sampler : {"classical", "dwivedi", "boundary", "modes"}) {
        const PlanarExperiment experiment = with_sampler(base, sampler, histogram_albedo);
        histograms.push_back({sampler_text(experiment), histogram_planar(experiment, run)});
    }
    std::vector<NamedWalks> walks;
    for (const char* sampler : {"classical", "modes"}) {
        const PlanarExperiment experiment = with_sampler(base, sampler, walks_albedo);
        walks.push_back({sampler_text(experiment), trace_planar(experiment, drawn_walks, run.seed)});
    }
    const PlanarHistogram& slice = histograms.front().histogram;
    return {
        {"variance.svg", "Variance of one walk: what is left of the noise as the guide knows more modes.",
         variance_svg(rows)},
        {"walks.svg",
         fmt::format("{} walks each at albedo {:g}, from their entry to their end: without a guide they get lost.",
                     drawn_walks, walks_albedo),
         walks_svg(walks)},
        {"depth.svg",
         fmt::format("Where walks first collide, at albedo {:g}. Walks without variance follow the exact density.",
                     histogram_albedo),
         depth_svg(histograms)},
        {"direction.svg",
         fmt::format("Where walks head after a first collision {:.2g} to {:.2g} mean free paths deep, at albedo {:g}.",
                     slice.depth_begin, slice.depth_end, histogram_albedo),
         direction_svg(histograms)}};
}

std::string html_row(const std::vector<std::string>& cells, const char* scope, const char* element) {
    std::string html = fmt::format("<tr><th scope=\"{}\">{}</th>", scope, escape_markup(cells[1]));
    for (std::size_t i = 2; i < cells.size(); ++i) {
        html += fmt::format("<{0}>{1}</{0}>", element, escape_markup(cells[i]));
    }
    return html + "</tr>\n";
}

/// The cells of halfspace_cells() with a group of rows for each albedo.
std::string html_table(const std::vector<std::vector<std::string>>& cells) {
    std::string html = "<thead>" + html_row(cells.front(), "col", "th") + "</thead>\n";
    for (std::size_t row = 1; row < cells.size(); ++row) {
        if (cells[row].front() != cells[row - 1].front()) {
            html += fmt::format("<tbody><tr class=\"best\"><th scope=\"rowgroup\" colspan=\"{}\">albedo {}</th></tr>\n",
                                cells[row].size() - 1, escape_markup(cells[row].front()));
        }
        html += html_row(cells[row], "row", "td");
    }
    return html;
}

constexpr std::string_view page_template = R"html(<header>
<p class="kicker">Wend</p>
<h1>{{title}}</h1>
<p class="scene">A walk enters an endlessly deep medium under a sky of radiance 1. {{walks}} walks a row.</p>
</header>
<main>
{{figures}}
<section>
<h2>All samplers</h2>
<div class="scroll" tabindex="0" role="region" aria-label="Table of results">
<table>
{{table}}</table>
</div>
<p class="note"><b>off by</b> is the distance from the exact mean in standard errors. <b>variance</b> is that of one walk, <b>collisions</b> are counted per walk, <b>seconds</b> are summed over threads and leave out the <b>set-up</b> beside them. <b>FOM</b> is 1&nbsp;/&nbsp;(relative error²&nbsp;·&nbsp;seconds), and <b>× classical</b> how many times faster the row reaches the same error as classical sampling.</p>
</section>
</main>
)html";

std::string page(const std::vector<Figure>& figures, const std::vector<std::vector<std::string>>& cells,
                 const PlanarRun& run) {
    std::string sections;
    for (const Figure& figure : figures) {
        sections += fmt::format("<section><figure>\n{}<figcaption>{}</figcaption></figure></section>\n", figure.svg,
                                escape_markup(figure.caption));
    }
    const std::string title = "The half-space experiment";
    return framed_page(title, "",
                       fill_template(page_template, {{"title", title},
                                                     {"walks", std::to_string(run.walks)},
                                                     {"figures", sections},
                                                     {"table", html_table(cells)}}));
}

/// With an empty line between albedos.
std::string grouped_text(std::vector<std::vector<std::string>> cells) {
    for (std::size_t i = cells.size(); i-- > 1;) {
        if (cells[i].front() != cells[i - 1].front()) {
            cells.emplace(cells.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
    return text_table(cells, 2);
}

std::vector<HalfspaceRow> run_with_progress(const PlanarExperiment& base, const PlanarRun& run,
                                            const CommonOptions& common, const Streams& streams) {
    const std::vector<PlanarExperiment> experiments = halfspace_experiments(base);
    ProgressBar bar(streams.err, !common.quiet, "halfspace");
    const auto start = std::chrono::steady_clock::now();
    return run_halfspace_table(experiments, run, [&](std::size_t index) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        const PlanarExperiment& next = experiments[index];
        bar.update(static_cast<double>(index) / static_cast<double>(experiments.size()), elapsed.count(),
                   fmt::format("albedo {:g}, {}", next.albedo.front(), sampler_text(next)));
    });
}

}  // namespace

void report_halfspace_table(const PlanarExperiment& base, const PlanarRun& run, const std::filesystem::path& folder,
                            const CommonOptions& common, const Streams& streams) {
    make_report_folder(folder);
    const std::vector<HalfspaceRow> rows = run_with_progress(base, run, common, streams);
    std::uint64_t rejected = 0;
    for (const HalfspaceRow& row : rows) {
        rejected += row.result.rejected;
    }
    warn_of_rejected(rejected, streams);
    const std::vector<std::vector<std::string>> cells = halfspace_cells(rows);
    const std::vector<Figure> drawn = figures(base, run, rows);
    for (const Figure& figure : drawn) {
        write_atomically(folder / figure.file, figure.svg);
    }
    write_atomically(folder / "index.html", page(drawn, cells, run));
    if (common.json != "-") {
        streams.out << grouped_text(cells) << "\nplots and the page index.html are in " << folder.string() << '\n'
                    << std::flush;
    }
    common.write_json(streams, halfspace_json(rows, run));
}

}  // namespace wend
