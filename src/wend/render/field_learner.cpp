#include <wend/render/field_learner.h>

#include <wend/guide/shared_learning.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace wend {
namespace {

// Photons from lights to smooth surfaces: one to so many walks, at least as many as this.
constexpr int fewest_photons = 1 << 14;
constexpr double walks_to_a_photon = 16, walks_to_an_idle_photon = 64;

// More vertices of one walk say little that is new: they are correlated.
constexpr std::size_t most_records_of_walk = 64;

/// The groups of caustic lobes that directions have to be drawn from. Where the fluence of a cell is E, of which a
/// group brings the share s within a lobe of density g, sampling with a density p finds the second moment
///     E² s² ∫ g² / p dω  ≈  E² s² g(mean) / (2 p(mean))
/// of it. Where that is less than E² times this, others' noise is more; where the field has learned the lobe, p is
/// enough. What the field knows nothing of is taken to be all that there is.
CausticMap beyond(const guide::Field& field, const CausticMap& caustics, bool in_volume) {
    constexpr float most_missed = 1;
    return caustics.keeping([&](const CausticMap::Cell& cell, const CausticMap::Group& group) {
        const guide::Region* region = field.find(group.place);
        if (!region) {
            return false;
        }
        if (!(region->fluence() > 0)) {
            return true;
        }
        const float share = cell.fluence(in_volume) * mean_value(group.light) / (cell.light * region->fluence());
        const float classical = region->defensive_fraction();
        const float density =
            classical * inv_4pi + (1 - classical) * region->incident(group.place).density(group.lobe.mean);
        return share * share * vmf_peak(group.lobe.kappa) > 2 * most_missed * density;
    });
}

}  // namespace

FieldLearner::FieldLearner(const LearningContext& context)
    : context_(context),
      fields_(context.settings.fields ? *context.settings.fields
                                      : guide::Fields{guide::Field::empty(context.scene.bounds()),
                                                      guide::Field::empty(context.scene.bounds())}),
      budget_(context.settings.most_records),
      guides_flights_(context.settings.preset.guides_distance() && has_fog(context.scene)) {
}

void FieldLearner::begin(const PassPlan& plan) {
    records_ = plan.fills_fields && !context_.settings.preset.is_classical();
    // Photons cost as much as the first samples do, which may be all. They are wanted where fields are given, too.
    const RenderSettings& settings = context_.settings;
    const bool are_due = plan.first >= warm_up_samples && (records_ || plan.first < settings.training_samples);
    if (!are_due || !plan.guides || !settings.preset.direction) {
        return;
    }
    if (fields_.surface.is_trained() || fields_.volume.is_trained()) {
        send_photons(plan.first);
    }
}

void FieldLearner::send_photons(int samples) {
    const bool are_idle = photons_sent_ > 0 && surface_caustics_.size() + volume_caustics_.size() == 0;
    const double wanted = context_.pixels * samples / (are_idle ? walks_to_an_idle_photon : walks_to_a_photon);
    const int due = static_cast<int>(std::clamp(wanted, double{fewest_photons}, double{most_photons}));
    // Anew, once there may be twice as many.
    if (due >= 2 * photons_sent_ || (due == most_photons && photons_sent_ < due)) {
        photons_sent_ = due;
        send_again();
    }
    surface_caustics_ = beyond(fields_.surface, photons_.on_surfaces(), false);
    volume_caustics_ = beyond(fields_.volume, photons_.in_media(), true);
}

void FieldLearner::send_again() {
    if (photons_sent_ > 0) {
        photons_ = CausticPhotons(context_.scene, photons_sent_, context_.settings.seed, context_.settings.threads);
    }
}

void FieldLearner::keep(Records& records, bool is_recorded) const {
    if (records_ && is_recorded) {
        records.records.add(records.log.vertices(), most_records_of_walk, guides_flights_);
    }
}

void FieldLearner::learn(std::vector<Records>& mine, const PassPlan& plan, TileShares& shares) {
    std::vector<guide::PathRecords> records;
    std::uint64_t count = 0;
    for (Records& tile : mine) {
        records.push_back(std::exchange(tile.records, {}));
        count += records.back().size();
    }
    const bool shows = static_cast<bool>(context_.settings.on_records);
    const std::vector<std::uint64_t> totals = shares.team().sum({count, shows ? 1u : 0u});
    budget_.learn(plan.recorded_walks, static_cast<double>(totals[0]));
    if (totals[1] > 0) {
        show(records, shares);
    }
    fields_ = guide::learn_together(fields_, std::move(records), context_.settings.threads, shares.team());
}

void FieldLearner::show(const std::vector<guide::PathRecords>& mine, TileShares& shares) const {
    std::vector<guide::PathRecords> all = mine;
    shares.gather([&](auto& bytes, std::size_t i) { bytes(all[i]); });
    if (context_.settings.on_records) {
        context_.settings.on_records(all);
    }
}

}  // namespace wend
