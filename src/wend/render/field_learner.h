// The learned fields of directions and light.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/fit.h>
#include <wend/light/caustic_photons.h>
#include <wend/render/learner.h>
#include <wend/render/record_budget.h>
#include <wend/transport/field_recorder.h>

#include <utility>

namespace wend {

class FieldLearner {
public:
    FieldLearner(const LearningContext& context);

    static constexpr bool steers = true;
    using Recorder = FieldRecorder;
    struct Records {
        guide::PathRecords records;
        guide::PathLog log;  ///< of the walk at hand
    };

    /// Sends photons where they are due.
    void begin(const PassPlan& plan);
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool is_recorded) const {
        return Recorder(records_ && is_recorded ? &records.log : nullptr);
    }
    void keep(Records& records, bool is_recorded) const;
    /// From the records of the tiles that this process walks; see LearnsTogether.
    void learn(std::vector<Records>& mine, const PassPlan& plan, TileShares& shares);

    /// Of so many walks, the share that is to be recorded.
    double recorded_share(double walks) const { return budget_.share(walks); }
    const guide::Fields& fields() const { return fields_; }
    /// What photons know that the fields do not.
    const CausticMap& surface_caustics() const { return surface_caustics_; }
    const CausticMap& volume_caustics() const { return volume_caustics_; }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& learner) {
        if constexpr (std::is_const_v<Self>) {
            bytes(guide::to_bytes(learner.fields_.surface), guide::to_bytes(learner.fields_.volume));
        } else {
            std::string surface, volume;
            bytes(surface, volume);
            learner.fields_ = {guide::field_from_bytes(surface), guide::field_from_bytes(volume)};
        }
        bytes(learner.photons_sent_, learner.surface_caustics_, learner.volume_caustics_, learner.budget_,
              learner.records_);
        bytes.require(learner.photons_sent_ >= 0 && learner.photons_sent_ <= most_photons);
        if constexpr (!std::is_const_v<Self>) {
            learner.send_again();
        }
    }
    template <class Archive, class OfTile>
    void archive_records(Archive& bytes, OfTile& records) const {
        bytes(records.records);
    }

private:
    static constexpr int most_photons = 1 << 20;

    /// All records, to whoever wants to see them, in whichever process.
    void show(const std::vector<guide::PathRecords>& mine, TileShares& shares) const;
    void send_photons(int samples);
    /// As many photons as were sent before.
    void send_again();

    LearningContext context_;
    guide::Fields fields_;
    CausticPhotons photons_;
    int photons_sent_ = 0;
    CausticMap surface_caustics_, volume_caustics_;
    RecordBudget budget_;
    bool guides_flights_;
    bool records_ = false;
};

static_assert(Learner<FieldLearner>);

}  // namespace wend
