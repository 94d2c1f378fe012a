#include <wend/render/field_learner.h>

#include <algorithm>
#include <utility>

namespace wend {
namespace {

// Photons from lights to smooth surfaces: as many as there have been walks, between these.
constexpr int fewest_photons = 1 << 14, most_photons = 1 << 20;
// More vertices of one walk say little that is new: they are correlated.
constexpr std::size_t most_records_of_walk = 64;

}  // namespace

FieldLearner::FieldLearner(const LearningContext& context)
    : context_(context),
      fields_(context.settings.fields ? *context.settings.fields
                                      : guide::Fields{guide::Field::empty(context.scene.bounds()),
                                                      guide::Field::empty(context.scene.bounds())}),
      budget_(context.settings.most_records) {
}

void FieldLearner::begin(const PassPlan& plan) {
    const Preset& preset = context_.settings.preset;
    records_ = plan.learns && !preset.is_classical();
    if (!records_ || !preset.direction) {
        return;
    }
    const int due =
        static_cast<int>(std::clamp(context_.pixels * plan.first, double{fewest_photons}, double{most_photons}));
    // Anew, once there may be twice as many.
    if (due >= 2 * photons_ || (due == most_photons && photons_ < due)) {
        caustics_ = CausticPhotons(context_.scene, due, context_.settings.seed, context_.settings.threads);
        photons_ = due;
    }
}

void FieldLearner::keep(Records& records, bool is_recorded) const {
    if (records_ && is_recorded) {
        records.records.add(records.log.vertices(), most_records_of_walk);
    }
}

void FieldLearner::learn(std::vector<Records>& all, const PassPlan& plan) {
    std::vector<guide::PathRecords> records;
    std::size_t count = 0;
    for (Records& tile : all) {
        records.push_back(std::exchange(tile.records, {}));
        count += records.back().size();
    }
    budget_.learn(plan.recorded_share * context_.walks(plan), static_cast<double>(count));
    if (context_.settings.on_records) {
        context_.settings.on_records(records);
    }
    fields_ = guide::learn(fields_, std::move(records), context_.settings.threads);
}

}  // namespace wend
