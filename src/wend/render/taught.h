// What a render has learned beside its fields, for others of the same scene that begin with these.
#pragma once

#include <wend/film/film.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/learners.h>
#include <wend/render/render.h>

#include <optional>
#include <string>
#include <vector>

namespace wend {

/// What pixels and their noise were, as the render that taught has found them: samples of another seed, which may steer
/// all samples of this one.
struct TaughtPicture {
    int samples = 0;  ///< of each pixel, as a mean
    /// Of each pixel of the crop, without exposure and balance.
    std::vector<float> means;
    /// PixelNoise::variance and work.
    std::vector<float> variances, work;
    double sample_variance = 0;  ///< PassPlan::sample_variance

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& picture) {
        bytes(picture.samples, picture.means, picture.variances, picture.work, picture.sample_variance);
        bytes.require(picture.samples > 0 && picture.variances.size() == picture.means.size() &&
                      picture.work.size() == picture.means.size());
    }

    /// With the samples that a film of the same pixels, not balanced but exposed, has had so far.
    Image with(const Image& shown, int shown_samples, float exposure) const;
    /// In place of what a film tells by few samples.
    std::vector<PixelNoise> noise(const std::vector<PixelNoise>& shown) const;
};

/// Notes for guide::Fields: which lights, techniques and reflections were learned, and, for the same picture, where
/// guiding pays and how noisy it is. `picture` may lack means: nothing is told of it then.
std::string notes_of(const LearningContext& context, const Film& film, const Learners& learners,
                     const GuidingChoice& choice, const TaughtPicture& picture);

/// Takes notes up. Those of another scene, or of other sampling, say nothing; those of another picture nothing of it.
/// Throws InputError for bytes that are no notes.
std::optional<TaughtPicture> take_notes(const std::string& notes, const LearningContext& context, const Film& film,
                                        Learners& learners, GuidingChoice& choice);

}  // namespace wend
