#include <wend/app/comparison.h>
#include <wend/app/comparison_data.h>
#include <wend/app/comparison_files.h>
#include <wend/app/comparison_page.h>
#include <wend/app/comparison_report.h>
#include <wend/app/gains.h>
#include <wend/app/parsed_scene.h>
#include <wend/app/reference_render.h>
#include <wend/app/report_folder.h>

#include "bindings.h"

#include <nlohmann/json.hpp>

namespace wend::python {
namespace {

using Watcher = nb::typed<nb::callable, void(std::string, int, double, double)>;

/// JSON as Python has it.
nb::object to_python(const nlohmann::json& json) {
    return nb::module_::import_("json").attr("loads")(json_text(json));
}

/// What a comparison found.
class PythonComparison {
public:
    explicit PythonComparison(Comparison comparison) : comparison_(std::move(comparison)) {}

    /// As the program's JSON has them, with runs and their points.
    Rows rows() const { return nb::cast<Rows>(to_python(comparison_json(comparison_))); }
    Values reference_facts() const { return nb::cast<Values>(to_python(reference_json(comparison_.reference))); }

    std::string table() const { return comparison_table(comparison_.rows); }
    std::string page() const { return comparison_page(comparison_); }
    void save(const std::string& folder) const {
        const nb::gil_scoped_release release;
        make_report_folder(folder);
        write_comparison(folder, comparison_);
    }

    /// The median run's.
    Picture picture(std::size_t row) const {
        const ComparisonRow& r = comparison_.rows.at(row);
        const Vec2i size(r.image.width, r.image.height);
        return {r.image, r.walks, {}, {0, 0}, size};
    }
    Picture errors(std::size_t row) const { return error_picture(comparison_.rows.at(row)); }
    Picture reference() const {
        return {comparison_.reference.halves.average(), {}, {}, {0, 0}, comparison_.reference.size()};
    }
    const Comparison& comparison() const { return comparison_; }

private:
    Comparison comparison_;
};

using Comparisons = std::vector<std::pair<std::string, const PythonComparison*>>;

/// Writes a report over several comparisons as the program does, each by its name.
void write_report(const Comparisons& comparisons, const std::string& folder) {
    const nb::gil_scoped_release release;
    std::vector<std::string> scenes;
    for (const auto& [name, one] : comparisons) {
        scenes.push_back(name);
    }
    ComparisonReport report(folder, scenes);
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        Comparison comparison = comparisons[i].second->comparison();
        comparison.scene = scenes[i];
        report.add(i, std::move(comparison));
    }
}

/// How gains are distributed over the scenes, as the program's JSON has it.
Rows gains(const Comparisons& comparisons) {
    std::vector<Comparison> all;
    for (const auto& [name, one] : comparisons) {
        Comparison& numbers = all.emplace_back();
        numbers.scene = name;
        for (const ComparisonRow& row : one->comparison().rows) {
            ComparisonRow& copy = numbers.rows.emplace_back();
            copy.way = row.way;
            copy.ratio = row.ratio;
            copy.runs = row.runs;
        }
    }
    return nb::cast<Rows>(to_python(gains_json(gain_distributions(all), all)));
}

/// Tells Python of a render on its way, which may throw, and lets signals arrive.
void tell(const Watcher& watcher, const std::string& name, int number, const RenderProgress& progress) {
    const nb::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) {
        throw nb::python_error();
    }
    watcher(name, number, progress.fraction, progress.seconds);
}

/// `ways` are pairs of names of how to sample, and how inside dense media. Without halves of a reference, one is
/// rendered first: by so many samples per pixel each, or so many seconds where these are none.
PythonComparison compare(const std::shared_ptr<ParsedScene>& scene,
                         const std::vector<std::pair<std::string, std::string>>& ways, double seconds, int seeds,
                         std::optional<Pixels> a, std::optional<Pixels> b, int reference_samples,
                         double reference_seconds, const Watcher& watcher) {
    ComparisonPlan plan{{}, seconds, seeds};
    for (const auto& [sampling, subsurface] : ways) {
        plan.ways.push_back({parse_preset(sampling), parse_subsurface(subsurface)});
    }
    KnownReference reference;
    if (a && b) {
        reference.halves = {to_image(*a), to_image(*b)};
    }
    const nb::gil_scoped_release release;
    const Session& session = scene->session();
    if (!a || !b) {
        reference = render_reference(
            session, {reference_samples, reference_seconds}, {},
            [&](int half, const RenderProgress& progress) { tell(watcher, "reference", half, progress); });
    }
    return PythonComparison(compare_presets(session, plan, std::move(reference),
                                            [&](const WayOfSampling& way, int seed, const RenderProgress& progress) {
                                                tell(watcher, to_string(way), seed, progress);
                                            }));
}

}  // namespace

void bind_comparisons(nb::module_& module) {
    nb::class_<PythonComparison>(module, "Comparison", "Ways of sampling in equal time.")
        .def("rows", &PythonComparison::rows)
        .def("reference_facts", &PythonComparison::reference_facts)
        .def("table", &PythonComparison::table)
        .def("page", &PythonComparison::page)
        .def("save", &PythonComparison::save, nb::arg("folder"))
        .def("picture", &PythonComparison::picture, nb::arg("row"))
        .def("errors", &PythonComparison::errors, nb::arg("row"))
        .def("reference", &PythonComparison::reference);
    module.def("compare", &compare, nb::arg("scene"), nb::arg("ways"), nb::arg("seconds"), nb::arg("seeds"),
               nb::arg("a").none(), nb::arg("b").none(), nb::arg("reference_samples"), nb::arg("reference_seconds"),
               nb::arg("watcher"));
    module.def("write_report", &write_report, nb::arg("comparisons"), nb::arg("folder"));
    module.def("gains", &gains, nb::arg("comparisons"));
    module.attr("reference_effort") = reference_effort;
}

}  // namespace wend::python
