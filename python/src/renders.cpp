#include <wend/app/comparison_data.h>
#include <wend/app/owned_render.h>
#include <wend/io/field_file.h>

#include "bindings.h"
#include "fields.h"

#include <nlohmann/json.hpp>

namespace wend::python {
namespace {

using FieldsPointer = std::shared_ptr<const guide::Fields>;

/// What it tells while other threads run.
template <class Ask>
auto without_gil(const Ask& ask) {
    const nb::gil_scoped_release release;
    return ask();
}

Values progress_of(const OwnedRender& render) {
    const RenderProgress p = without_gil([&] { return render.progress(); });
    Values result;
    result["fraction"] = p.fraction;
    result["seconds"] = p.seconds;
    result["seconds_left"] = p.seconds_left;
    result["spp"] = p.samples;
    result["relative_noise"] = p.relative_noise;
    return result;
}

Values statistics_of(const OwnedRender& render) {
    const RenderStatistics s = without_gil([&] { return render.statistics(); });
    Values result;
    result["spp"] = s.samples;
    result["seconds"] = s.seconds;
    result["training_seconds"] = s.training_seconds;
    result["paths"] = s.counts.paths;
    result["segments"] = s.counts.segments;
    result["rejected_samples"] = s.counts.rejected;
    result["field_bytes"] = s.field_bytes;
    result["passes"] = s.passes;
    result["guiding"] = nb::module_::import_("json").attr("loads")(kinds_json(s.kinds).dump());
    return result;
}

/// A copy; null where nothing is guided.
std::shared_ptr<guide::Fields> fields_of(const OwnedRender& render) {
    const FieldsPointer learned = render.fields();
    return learned ? std::make_shared<guide::Fields>(*learned) : nullptr;
}

}  // namespace

void bind_renders(nb::module_& module) {
    const nb::call_guard<nb::gil_scoped_release> others_run;
    nb::class_<OwnedRender>(module, "Render", "A render that is stepped.")
        .def(
            "__init__",
            [](OwnedRender* self, std::shared_ptr<ParsedScene> scene, int samples, double seconds, double noise,
               std::vector<int> passes, const std::string& sampling, const std::string& subsurface,
               FieldsPointer fields, bool keeps_fields, std::optional<std::uint64_t> seed, int threads,
               std::vector<std::string> layers) {
                new (self)
                    OwnedRender(std::move(scene), {samples, seconds, noise, std::move(passes), sampling, subsurface,
                                                   std::move(fields), keeps_fields, seed, threads, std::move(layers)});
            },
            nb::arg("scene"), nb::arg("spp"), nb::arg("seconds"), nb::arg("noise"), nb::arg("passes"),
            nb::arg("sampling"), nb::arg("subsurface"), nb::arg("fields").none(), nb::arg("keeps_fields"),
            nb::arg("seed").none(), nb::arg("threads"), nb::arg("layers"))
        .def("step", &OwnedRender::step, nb::arg("seconds"), others_run)
        .def_prop_ro("is_within_pass", &OwnedRender::is_within_pass, others_run)
        .def_prop_ro("is_stopped", &OwnedRender::is_stopped, others_run)
        .def("set_stop", &OwnedRender::set_stop, nb::arg("stop"))
        .def("progress", &progress_of)
        .def("statistics", &statistics_of)
        .def("picture", &OwnedRender::picture, others_run)
        .def("fields", &fields_of, others_run)
        .def(
            "save", [](const OwnedRender& render, const std::string& file) { render.save(file); }, nb::arg("file"),
            others_run)
        .def(
            "resume", [](OwnedRender& render, const std::string& file) { render.resume(file); }, nb::arg("file"),
            others_run);
}

}  // namespace wend::python
