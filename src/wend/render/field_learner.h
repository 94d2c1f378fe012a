// The learned fields of directions and light.
#pragma once

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
    void learn(std::vector<Records>& all, const PassPlan& plan);

    /// Of so many walks, the share that is to be recorded.
    double recorded_share(double walks) const { return budget_.share(walks); }
    const guide::Fields& fields() const { return fields_; }
    guide::Fields take_fields() { return std::move(fields_); }
    /// What photons know that the fields do not.
    const CausticMap& surface_caustics() const { return surface_caustics_; }
    const CausticMap& volume_caustics() const { return volume_caustics_; }

private:
    void send_photons(int samples);

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
