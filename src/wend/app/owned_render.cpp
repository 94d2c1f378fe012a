#include <wend/app/owned_render.h>

#include <wend/app/checkpoint.h>
#include <wend/app/extra_layers.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>

#include <cmath>
#include <utility>

namespace wend {
namespace {

void require(bool is_right, const char* message) {
    if (!is_right) {
        throw InputError(message);
    }
}

void check(const RenderChoices& choices) {
    require(choices.samples >= 0 && choices.samples <= RenderSettings::most_samples, "samples: expected 0 to 2^30");
    require(choices.seconds >= 0 && std::isfinite(choices.seconds), "seconds: expected a number from 0 on");
    require(choices.noise >= 0 && std::isfinite(choices.noise), "noise: expected a number from 0 on");
    std::int64_t sum = 0;
    for (const int samples : choices.passes) {
        require(samples > 0, "passes: expected positive numbers of samples");
        sum += samples;
    }
    require(sum <= RenderSettings::most_samples, "passes: more than 2^30 samples");
    require(choices.threads >= 0 && choices.threads <= 4096, "threads: expected 0, for all, to 4096");
}

RenderSettings settings_for(const Session& session, const RenderChoices& choices) {
    RenderSettings settings = session.settings();
    ask_for_layers(choices.layers, session.scene(), settings);
    return settings;
}

}  // namespace

OwnedRender::OwnedRender(std::shared_ptr<const ParsedScene> scene, const RenderChoices& choices)
    : scene_(std::move(scene)),
      settings_(settings_for(scene_->session(), choices)),
      film_(scene_->session().new_film(settings_)) {
    check(choices);
    settings_.preset = parse_preset(choices.sampling);
    settings_.subsurface = parse_subsurface(choices.subsurface);
    settings_.samples = choices.samples > 0 ? choices.samples
                        : choices.noise > 0 ? RenderSettings::most_samples
                                            : settings_.samples;
    settings_.seconds = choices.seconds;
    settings_.noise = choices.noise;
    settings_.passes = choices.passes;
    settings_.fields = choices.fields;
    settings_.keeps_fields = choices.keeps_fields;
    settings_.seed = choices.seed.value_or(settings_.seed);
    settings_.threads = choices.threads;
    settings_.stop = &stop_;
    if (settings_.fields && settings_.preset.is_classical()) {
        throw InputError("fields: classical sampling follows none; choose another sampling");
    }
    render_.emplace(scene_->session().scene(), film_, settings_);
}

bool OwnedRender::step(double seconds) {
    const std::scoped_lock lock(mutex_);
    return render_->step(seconds);
}

bool OwnedRender::is_within_pass() const {
    const std::scoped_lock lock(mutex_);
    return render_->is_within_pass();
}

bool OwnedRender::is_stopped() const {
    const std::scoped_lock lock(mutex_);
    return render_->is_stopped();
}

RenderProgress OwnedRender::progress() const {
    const std::scoped_lock lock(mutex_);
    return render_->progress();
}

RenderStatistics OwnedRender::statistics() const {
    const std::scoped_lock lock(mutex_);
    return render_->statistics();
}

std::shared_ptr<const guide::Fields> OwnedRender::fields() const {
    const std::scoped_lock lock(mutex_);
    return render_->result().fields;
}

Picture OwnedRender::picture() const {
    const std::scoped_lock lock(mutex_);
    return scene_->session().picture(film_, settings_, render_->statistics());
}

void OwnedRender::save(const std::filesystem::path& file) const {
    require_writable(file);
    const std::scoped_lock lock(mutex_);
    save_checkpoint(file, *render_, scene_->session(), settings_);
}

void OwnedRender::resume(const std::filesystem::path& file) {
    const std::scoped_lock lock(mutex_);
    resume_from(file, *render_, scene_->session(), settings_);
}

}  // namespace wend
