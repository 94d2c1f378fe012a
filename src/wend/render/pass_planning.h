// What the next pass does, by what is known so far.
#pragma once

#include <wend/film/film.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/learners.h>
#include <wend/render/taught.h>

namespace wend {

/// All that decides it.
struct KnownSoFar {
    const LearningContext& context;
    const Film& film;
    const Learners& learners;
    const GuidingChoice& choice;
    const TaughtPicture* taught;  ///< by an earlier render; null: nothing
};

/// How far a render is.
struct RenderedSoFar {
    int samples = 0;      ///< of each pixel, as a mean
    double recorded = 0;  ///< of these, what the fields have learned from
    double noise = 0;     ///< Film::relative_noise()
};

/// A pass of `count` samples of each pixel, as a mean. `is_last`: whether none follows it.
PassPlan plan_pass(const KnownSoFar& known, const RenderedSoFar& rendered, int count, bool is_last);

/// What a film tells later renders of its picture; nothing by few samples, or where no light is let through to it.
TaughtPicture picture_seen(const LearningContext& context, const Film& film, int samples);

}  // namespace wend
