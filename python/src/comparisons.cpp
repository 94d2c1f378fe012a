#include <wend/app/comparison.h>
#include <wend/app/comparison_page.h>
#include <wend/app/parsed_scene.h>
#include <wend/app/reference_render.h>
#include <wend/app/report_folder.h>

#include "bindings.h"

#include <nlohmann/json.hpp>

namespace wend::python {
namespace {

using Watcher = nb::typed<nb::callable, void(std::string, int, double, double)>;

/// A comparison and what it was judged by.
class PythonComparison {
public:
    PythonComparison(std::shared_ptr<ParsedScene> scene, double seconds, int seeds, Reference reference,
                     std::vector<ComparisonRow> rows)
        : scene_(std::move(scene)),
          seconds_(seconds),
          seeds_(seeds),
          reference_(std::move(reference)),
          rows_(std::move(rows)) {}

    Rows rows() const {
        return nb::cast<Rows>(nb::module_::import_("json").attr("loads")(comparison_json(rows_).dump()));
    }

    Rows runs() const {
        Rows all;
        for (const ComparisonRow& row : rows_) {
            for (std::size_t seed = 0; seed < row.runs.size(); ++seed) {
                const ComparisonRun& run = row.runs[seed];
                Values one;
                one["sampling"] = to_string(row.way);
                one["seed"] = seed;
                one["spp"] = run.samples;
                one["seconds"] = run.seconds;
                one["relmse"] = run.metrics.relmse;
                one["relmse_trimmed"] = run.metrics.relmse_trimmed;
                one["mse"] = run.metrics.mse;
                one["mape"] = run.metrics.mape;
                all.append(one);
            }
        }
        return all;
    }

    Rows curves() const {
        Rows all;
        for (const ComparisonRow& row : rows_) {
            for (std::size_t seed = 0; seed < row.runs.size(); ++seed) {
                for (const ConvergenceSeries::Point& point : row.runs[seed].points) {
                    Values one;
                    one["sampling"] = to_string(row.way);
                    one["seed"] = seed;
                    one["seconds"] = point.seconds;
                    one["relmse"] = point.relmse;
                    all.append(one);
                }
            }
        }
        return all;
    }

    std::string table() const { return comparison_table(rows_); }
    std::string page() const { return comparison_page(scene_->session(), rows_, reference_, seconds_, seeds_); }
    void save(const std::string& folder) const {
        const nb::gil_scoped_release release;
        make_report_folder(folder);
        write_comparison(folder, scene_->session(), rows_, reference_, seconds_, seeds_);
    }

    /// The median run's.
    Picture picture(std::size_t row) const {
        const ComparisonRow& r = rows_.at(row);
        const Vec2i size(r.image.width, r.image.height);
        return {r.image, r.walks, {}, {0, 0}, size};
    }
    Picture reference() const {
        const Vec2i size(reference_.a.width, reference_.a.height);
        return {reference_.average(), {}, {}, {0, 0}, size};
    }

private:
    std::shared_ptr<ParsedScene> scene_;
    double seconds_;
    int seeds_;
    Reference reference_;
    std::vector<ComparisonRow> rows_;
};

/// Tells Python of a render on its way, which may throw, and lets signals arrive.
void tell(const Watcher& watcher, const std::string& name, int number, const RenderProgress& progress) {
    const nb::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) {
        throw nb::python_error();
    }
    watcher(name, number, progress.fraction, progress.seconds);
}

/// `ways` are pairs of names of how to sample, and how inside dense media. Without halves of a reference, one is
/// rendered first.
PythonComparison compare(std::shared_ptr<ParsedScene> scene,
                         const std::vector<std::pair<std::string, std::string>>& ways, double seconds, int seeds,
                         std::optional<Pixels> a, std::optional<Pixels> b, const Watcher& watcher) {
    std::vector<WayOfSampling> compared;
    for (const auto& [sampling, subsurface] : ways) {
        compared.push_back({parse_preset(sampling), parse_subsurface(subsurface)});
    }
    Reference reference;
    if (a && b) {
        reference = {to_image(*a), to_image(*b)};
    }
    const nb::gil_scoped_release release;
    const Session& session = scene->session();
    if (!a || !b) {
        reference = render_reference(session, seconds, {}, [&](int half, const RenderProgress& progress) {
            tell(watcher, "reference", half, progress);
        });
    }
    auto rows = compare_presets(session, compared, seconds, seeds, reference,
                                [&](const WayOfSampling& way, int seed, const RenderProgress& progress) {
                                    tell(watcher, to_string(way), seed, progress);
                                });
    return {std::move(scene), seconds, seeds, std::move(reference), std::move(rows)};
}

}  // namespace

void bind_comparisons(nb::module_& module) {
    nb::class_<PythonComparison>(module, "Comparison", "Ways of sampling in equal time.")
        .def("rows", &PythonComparison::rows)
        .def("runs", &PythonComparison::runs)
        .def("curves", &PythonComparison::curves)
        .def("table", &PythonComparison::table)
        .def("page", &PythonComparison::page)
        .def("save", &PythonComparison::save, nb::arg("folder"))
        .def("picture", &PythonComparison::picture, nb::arg("row"))
        .def("reference", &PythonComparison::reference);
    module.def("compare", &compare, nb::arg("scene"), nb::arg("ways"), nb::arg("seconds"), nb::arg("seeds"),
               nb::arg("a").none(), nb::arg("b").none(), nb::arg("watcher"));
    module.attr("reference_effort") = reference_effort;
}

}  // namespace wend::python
