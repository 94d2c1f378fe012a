#include <wend/render/taught.h>

#include <wend/core/archive.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wend {
namespace {

/// What must be the same for what was learned of it to have the same size and meaning.
std::string key_of_scene(const LearningContext& context) {
    const Box3 bounds = context.scene.bounds();
    std::vector<std::uint64_t> media;
    for (const Medium& medium : context.scene.description().media) {
        media.push_back(medium.index());
    }
    ArchiveWriter key;
    key(bounds.min, bounds.max, static_cast<std::uint64_t>(context.scene.lights().size()), media,
        to_string(context.settings.subsurface));
    return key.take();
}

std::string key_of_picture(const LearningContext& context, const Film& film) {
    ArchiveWriter key;
    key(film.full_size(), film.crop(), to_string(context.settings.preset), context.settings.preset.adaptive);
    return key.take();
}

bool are_numbers(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x) && x >= 0; });
}

}  // namespace

Image TaughtPicture::with(const Image& shown, int shown_samples, float exposure) const {
    Image all = shown;
    const float weight = static_cast<float>(shown_samples) / static_cast<float>(shown_samples + samples);
    for (std::size_t i = 0; i < means.size(); ++i) {
        all.pixels[i] = Rgb((1 - weight) * exposure * means[i] + weight * mean_value(shown.pixels[i]));
    }
    return all;
}

std::vector<PixelNoise> TaughtPicture::noise(const std::vector<PixelNoise>& shown) const {
    std::vector<PixelNoise> all = shown;
    for (std::size_t i = 0; i < means.size(); ++i) {
        all[i].variance = static_cast<double>(variances[i]);
        all[i].work = static_cast<double>(work[i]);
        all[i].samples = all[i].count;
    }
    return all;
}

std::string notes_of(const LearningContext& context, const Film& film, const Learners& learners,
                     const GuidingChoice& choice, const TaughtPicture& picture) {
    const bool tells_of_picture = !picture.means.empty() && (choice.kinds().size() == 1 || choice.has_chosen());
    ArchiveWriter notes;
    notes(key_of_scene(context), learners.get<InteriorLearner>().dense_media());
    Learners::archive_beside_fields(notes, learners);
    notes(tells_of_picture);
    if (tells_of_picture) {
        notes(key_of_picture(context, film), choice, picture);
    }
    return notes.take();
}

std::optional<TaughtPicture> take_notes(const std::string& notes, const LearningContext& context, const Film& film,
                                        Learners& learners, GuidingChoice& choice) {
    if (notes.empty()) {
        return {};
    }
    ArchiveReader bytes(notes);
    std::string key;
    std::vector<int> dense;
    bytes(key, dense);
    InteriorLearner& interior = learners.get<InteriorLearner>();
    if (key != key_of_scene(context) ||
        (!dense.empty() && !(interior.can_guide() && interior.has_dense_media(dense)))) {
        return {};
    }
    bool tells_of_picture = false;
    Learners::archive_beside_fields(bytes, learners);
    bytes(tells_of_picture);
    if (!tells_of_picture) {
        return {};
    }
    bytes(key);
    if (key != key_of_picture(context, film)) {
        return {};
    }
    TaughtPicture picture;
    bytes(choice, picture);
    bytes.require(bytes.empty() && picture.means.size() == static_cast<std::size_t>(context.pixels) &&
                  are_numbers(picture.means) && are_numbers(picture.variances) && are_numbers(picture.work) &&
                  std::isfinite(picture.sample_variance) && picture.sample_variance >= 0);
    return picture;
}

}  // namespace wend
