#include <wend/render/pass_planning.h>

#include <wend/decision/roulette_splitting.h>
#include <wend/render/noise_target.h>
#include <wend/render/sample_budget.h>
#include <wend/render/schedule.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// A film's picture before its white was balanced.
Image as_in_scene(const Film& film, const ColourMatrix& balance) {
    Image picture = film.beauty();
    if (!balance.is_identity()) {
        const ColourMatrix back = balance.inverse();
        for (Rgb& pixel : picture.pixels) {
            pixel = back * pixel;
        }
    }
    return picture;
}

/// Whether to learn from a pass costs more than it brings a render that keeps nothing: the last one, and any of a
/// render that is not longer than the one that taught it, since what is new replaces a part of what was known.
bool learns_in_vain(const KnownSoFar& known, bool is_last) {
    return (is_last && known.choice.kinds().size() > 1) ||
           (known.taught && Schedule(known.context.settings).total() <= known.taught->samples);
}

/// Whether a render ends before any of its walks but a few follow the fields: too few samples are left for a trial once
/// there is something to try.
bool ends_before_trial(const KnownSoFar& known) {
    constexpr int before_trial = 3;
    const auto kinds = static_cast<int>(known.choice.kinds().size());
    return kinds > 1 && !known.taught && Schedule(known.context.settings).total() < before_trial + kinds;
}

double mean_variance(const std::vector<PixelNoise>& noise) {
    double sum = 0;
    for (const PixelNoise& pixel : noise) {
        sum += pixel.variance / static_cast<double>(noise.size());
    }
    return sum;
}

}  // namespace

PassPlan plan_pass(const KnownSoFar& known, const RenderedSoFar& rendered, int count, bool is_last) {
    const auto& [context, film, learners, choice, taught] = known;
    const RenderSettings& settings = context.settings;
    const Preset& preset = settings.preset;
    const int samples = rendered.samples;
    PassPlan plan;
    plan.first = samples;
    plan.count = count;
    const int enough = settings.training_samples;
    const bool is_taught = samples >= enough && (rendered.recorded >= enough || !choice.guiding_pays());
    plan.learns = !is_taught && (settings.keeps_fields || !learns_in_vain(known, is_last));
    plan.is_of_guided_render = !ends_before_trial(known);
    plan.fills_fields = plan.learns && (settings.keeps_fields || plan.is_of_guided_render);
    plan.guides = choice.guides(count);
    plan.steers = preset.direction || learners.get<InteriorLearner>().can_guide();
    // In a small picture the fields would learn from too few.
    constexpr double fewest_recorded = 1024;
    const double walks = context.walks(plan);
    const double most_recorded = learners.get<FieldLearner>().recorded_share(walks);
    const double wanted = std::max(choice.recorded_share(count), fewest_recorded / walks);
    const double directed = choice.directed_share(count);
    plan.recorded_share = std::min(most_recorded, wanted);
    plan.recorded_share_directed = std::min(most_recorded, 2 * wanted / std::max(directed, wanted));
    plan.recorded_walks = walks * ((1 - directed) * plan.recorded_share + directed * plan.recorded_share_directed);
    double sample_variance = std::pow(rendered.noise, 2) * samples;
    const bool knows_noise = samples >= known_noise;
    if (!knows_noise && taught) {
        sample_variance = taught->sample_variance;
    }
    // Every pixel has one sample in any case.
    if (preset.adaptive && (knows_noise || (taught && samples > 0))) {
        const std::vector<PixelNoise> noise = knows_noise ? film.noise() : taught->noise(film.noise());
        sample_variance = mean_variance(noise);
        for (const PixelNoise& pixel : noise) {
            plan.firsts.push_back(pixel.count);
        }
        // In a trial all kinds of walks are to be compared everywhere.
        if (!choice.is_trial()) {
            plan.counts = sample_counts(noise, film.crop().width(), count, settings.seed);
        }
    }
    if (preset.guides_survival() && (samples > 0 || taught) && settings.exposure > 0) {
        const Image shown = as_in_scene(film, settings.balance);
        plan.estimates =
            taught ? pixel_estimates(taught->with(shown, samples, settings.exposure), taught->samples + samples)
                   : pixel_estimates(shown, samples);
        for (float& estimate : plan.estimates) {
            estimate /= settings.exposure;
            plan.mean_estimate += static_cast<double>(estimate) / context.pixels;
        }
        plan.sample_variance = sample_variance;
    }
    return plan;
}

TaughtPicture picture_seen(const LearningContext& context, const Film& film, int samples) {
    if (samples < known_noise || !(context.settings.exposure > 0)) {
        return {};
    }
    TaughtPicture picture;
    picture.samples = samples;
    for (const Rgb& pixel : as_in_scene(film, context.settings.balance).pixels) {
        picture.means.push_back(std::max(0.0f, mean_value(pixel)) / context.settings.exposure);
    }
    const std::vector<PixelNoise> noise = film.noise();
    for (const PixelNoise& pixel : noise) {
        picture.variances.push_back(static_cast<float>(pixel.variance));
        picture.work.push_back(static_cast<float>(pixel.work));
    }
    picture.sample_variance = mean_variance(noise);
    return picture;
}

}  // namespace wend
