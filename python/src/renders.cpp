#include <wend/app/checkpoint.h>
#include <wend/app/comparison.h>
#include <wend/core/error.h>
#include <wend/io/field_file.h>
#include <wend/render/render.h>

#include "bindings.h"
#include "fields.h"
#include "scenes.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <mutex>

namespace wend::python {
namespace {

using FieldsPointer = std::shared_ptr<const guide::Fields>;

/// A render that is stepped. Any thread may call it; all but stop() wait for a step that is under way.
class PythonRender {
    static constexpr int most_samples = 1 << 30;

    template <class Action>
    auto locked(const Action& action) {
        const nb::gil_scoped_release release;
        const std::scoped_lock lock(mutex_);
        return action();
    }

public:
    PythonRender(std::shared_ptr<PythonScene> scene, int samples, double seconds, double noise, std::vector<int> passes,
                 const std::string& sampling, const std::string& subsurface, FieldsPointer fields, bool keeps_fields,
                 std::optional<std::uint64_t> seed, int threads)
        : scene_(std::move(scene)), settings_(scene_->session().settings()), film_(scene_->session().new_film()) {
        settings_.preset = parse_preset(sampling);
        settings_.subsurface = parse_subsurface(subsurface);
        settings_.samples = samples > 0 ? samples : noise > 0 ? most_samples : settings_.samples;
        settings_.seconds = seconds;
        settings_.noise = noise;
        settings_.passes = std::move(passes);
        settings_.fields = std::move(fields);
        settings_.keeps_fields = keeps_fields;
        settings_.seed = seed.value_or(settings_.seed);
        settings_.threads = threads;
        settings_.stop = &stop_;
        if (settings_.fields && settings_.preset.is_classical()) {
            throw InputError("fields: classical sampling follows none; choose another sampling");
        }
        render_.emplace(scene_->session().scene(), film_, settings_);
    }

    bool step(double seconds) {
        return locked([&] { return render_->step(seconds); });
    }
    bool is_within_pass() {
        return locked([&] { return render_->is_within_pass(); });
    }
    bool is_stopped() {
        return locked([&] { return render_->is_stopped(); });
    }
    void set_stop(bool stop) { stop_ = stop; }

    Values progress() {
        const RenderProgress p = locked([&] { return render_->progress(); });
        Values result;
        result["fraction"] = p.fraction;
        result["seconds"] = p.seconds;
        result["seconds_left"] = p.seconds_left;
        result["spp"] = p.samples;
        result["relative_noise"] = p.relative_noise;
        return result;
    }

    Values statistics() {
        const RenderStatistics s = locked([&] { return render_->statistics(); });
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

    Picture picture() {
        return locked([&] { return scene_->session().picture(film_, settings_, render_->statistics()); });
    }

    /// Throws what Render::result() throws; null where nothing is guided.
    std::shared_ptr<guide::Fields> fields() {
        const FieldsPointer learned = locked([&] { return render_->result().fields; });
        return learned ? std::make_shared<guide::Fields>(*learned) : nullptr;
    }

    void save(const std::string& file) {
        locked([&] { save_checkpoint(file, *render_, scene_->session(), settings_); });
    }
    void resume(const std::string& file) {
        locked([&] { resume_from(file, *render_, scene_->session(), settings_); });
    }
    std::shared_ptr<PythonScene> scene() const { return scene_; }

private:
    std::shared_ptr<PythonScene> scene_;
    RenderSettings settings_;
    Film film_;
    std::atomic<bool> stop_{false};
    std::optional<Render> render_;
    std::mutex mutex_;
};

}  // namespace

void bind_renders(nb::module_& module) {
    nb::class_<PythonRender>(module, "Render", "A render that is stepped.")
        .def(nb::init<std::shared_ptr<PythonScene>, int, double, double, std::vector<int>, const std::string&,
                      const std::string&, FieldsPointer, bool, std::optional<std::uint64_t>, int>(),
             nb::arg("scene"), nb::arg("spp"), nb::arg("seconds"), nb::arg("noise"), nb::arg("passes"),
             nb::arg("sampling"), nb::arg("subsurface"), nb::arg("fields").none(), nb::arg("keeps_fields"),
             nb::arg("seed").none(), nb::arg("threads"))
        .def("step", &PythonRender::step, nb::arg("seconds"))
        .def_prop_ro("is_within_pass", &PythonRender::is_within_pass)
        .def_prop_ro("is_stopped", &PythonRender::is_stopped)
        .def("set_stop", &PythonRender::set_stop, nb::arg("stop"))
        .def("progress", &PythonRender::progress)
        .def("statistics", &PythonRender::statistics)
        .def("picture", &PythonRender::picture)
        .def("fields", &PythonRender::fields)
        .def("save", &PythonRender::save, nb::arg("file"))
        .def("resume", &PythonRender::resume, nb::arg("file"))
        .def_prop_ro("scene", &PythonRender::scene);
}

}  // namespace wend::python
