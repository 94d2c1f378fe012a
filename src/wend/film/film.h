#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/film/cryptomatte.h>
#include <wend/film/film_layers.h>
#include <wend/film/part_sums.h>
#include <wend/film/picture.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wend {

/// What one camera sample leaves on the film.
struct FilmSample {
    Rgb radiance;
    bool guided = false;         ///< whether any decision was
    std::uint32_t segments = 0;  ///< flights to a collision, surface or interface, of all branches
    std::uint32_t branches = 1;  ///< 1 and one more for each copy that splitting made
    bool is_of_half_a = false;   ///< FilmLayers::halves
};

/// What a camera ray shows of the scene, which does not hang on how paths are drawn.
struct FilmFeatures {
    Rgb albedo;
    Vec3 normal{0, 0, 0};
    float depth = 0;    ///< distance to the first surface, media left out; 0 where there is none
    float opacity = 0;  ///< of media before it: an estimate of 1 - transmittance
    float alpha = 0;    ///< 1 where there is a surface, else the opacity of all media on the straight way
    /// Of the first surface, in the world: where it is, and its geometric normal; 0 where there is none.
    Vec3 position{0, 0, 0}, face_normal{0, 0, 0};
};

/// A rectangle of pixels, the upper end exclusive.
struct PixelRect {
    Vec2i min{0, 0};
    Vec2i max{0, 0};

    int width() const { return max.x - min.x; }
    int height() const { return max.y - min.y; }
    /// In a list of its pixels, row by row.
    std::size_t place_of(const Vec2i& pixel) const {
        return static_cast<std::size_t>(pixel.y - min.y) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(pixel.x - min.x);
    }
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// What is known of the noise of a pixel.
struct PixelNoise {
    double variance = 0;  ///< of one sample of the stage at hand, relative to what its half of the pixels shows there
    double samples = 0;   ///< of that stage, that would tell the pixel as well as all that it has had
    double work = 0;      ///< segments of a sample
    std::uint32_t count = 0;  ///< samples that it has had
};

/// Sums of samples, pixel by pixel. Two threads must not add to the same pixel.
///
/// Samples come in stages, as what draws them learns. A stage counts by its inverse relative variance, as far as that
/// is no chance, and no less than the one before: by few samples, noise that comes with rare values is easily missed.
/// What earlier stages clearly lack of the light of the last one is such noise, and makes them count less. So that no
/// sample has a say in its own weight, which would darken the picture, the pixels are divided like the fields of a
/// chess board, and those of one colour are weighted by what the other shows.
class Film {
public:
    /// Throws InputError if the crop window is empty, outside the picture, or larger than max_pixels.
    Film(const Vec2i& full_size, const PixelRect& crop, FilmLayers layers = {});

    const Vec2i& full_size() const { return full_size_; }
    const PixelRect& crop() const { return crop_; }
    const FilmLayers& layers() const { return layers_; }

    /// Adds a finite sample; `pixel` is in coordinates of the full picture.
    void add(const Vec2i& pixel, const FilmSample& sample);
    /// Adds the parts of a sample that was added, as many as FilmLayers::parts.
    void add_parts(const Vec2i& pixel, std::span<const std::array<double, 3>> parts);
    /// Adds what one of its rays shows.
    void add_features(const Vec2i& pixel, const FilmFeatures& features);
    /// Adds which objects one of its rays shows, how much each: for FilmLayers::objects.
    void add_coverage(const Vec2i& pixel, std::span<const Coverage> seen);
    /// Counts a sample that was not a number: it adds nothing, but is not forgotten.
    void reject(const Vec2i& pixel, bool is_of_half_a = false);

    /// Ends a stage: samples from here on are drawn in another way.
    void begin_stage();

    Image beauty() const;
    /// Beauty and the layers albedo, normal, depth and alpha of what its rays show, samples, variance (of the pixel's
    /// mean, from the scatter of its samples; with stratified samples an overestimate), walk_layers(), and what was
    /// asked for of FilmLayers.
    ///
    /// The halves are means over the samples of each half, moved together as far as these differ in what their samples
    /// count: the mean of both is the beauty, both have its expectation, and they are not correlated, so that a quarter
    /// of their squared difference estimates the beauty's variance.
    Picture picture() const;
    /// `scatter`, the opacity of media before the first surface, by its rays; and what walks did, over the samples of
    /// all stages alike: `segments`, the mean length of walks, `branches`, the mean
    /// number of those that splitting made of one, and `guided`, the share of samples whose walks were guided.
    std::vector<Layer> walk_layers() const;
    /// Root mean square of the relative standard error of pixels, their luminance measured against at least a tenth of
    /// the mean.
    double relative_noise() const;
    /// Of each pixel, row by row.
    std::vector<PixelNoise> noise() const;

    /// All that it holds, for a film of the same size; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& film) {
        bytes.same(film.full_size_);
        bytes.same(film.crop_);
        bytes.same(film.parts_.parts());
        bytes.same(film.geometry_.size());
        bytes.same(film.coverage_.size());
        bytes(film.earlier_weights_, film.first_noise_);
        archive_pixels(bytes, film, 0, film.pixels_.size());
    }

    /// The pixels of a part of the crop window alone.
    template <class Archive, class Self>
    static void archive_part(Archive& bytes, Self& film, const PixelRect& part) {
        for (int y = part.min.y; y < part.max.y; ++y) {
            archive_pixels(bytes, film, film.crop_.place_of({part.min.x, y}), static_cast<std::size_t>(part.width()));
        }
    }

    static constexpr std::int64_t max_pixels = std::int64_t{1} << 27;

private:
    struct Pixel {
        // Of the current stage.
        double sum[3] = {0, 0, 0};
        double squares[3] = {0, 0, 0};
        std::uint32_t count = 0;
        // Of the stages before, weighted: `spread` is the variance of `sum`.
        std::uint32_t earlier_count = 0;
        double earlier_weight = 0;
        double earlier_sum[3] = {0, 0, 0};
        double earlier_spread[3] = {0, 0, 0};
        // Of the rays whose features were added.
        float albedo[3] = {0, 0, 0};
        float normal[3] = {0, 0, 0};
        float depth = 0;
        float opacity = 0;
        float alpha = 0;
        std::uint32_t featured = 0;
        // Of all samples.
        std::uint32_t guided = 0;
        std::uint64_t segments = 0;
        std::uint64_t branches = 0;

        std::uint32_t samples() const { return count + earlier_count; }
        /// Variance of one sample in this stage; 0 where it is not known.
        double variance(int c) const;
        /// The same, or where one sample alone does not tell it that of samples before.
        double likely_variance(int c) const;
        /// The pixel where samples of this stage count `weight` times: its mean, and the variance of that.
        double weight(double weight) const { return earlier_weight + weight * count; }
        double mean(int c, double weight) const;
        double spread(int c, double weight) const;
    };
    /// Sums of what rays show.
    struct Geometry {
        float position[3] = {0, 0, 0};
        float face_normal[3] = {0, 0, 0};
    };
    /// By half of the pixels.
    using Halves = std::array<double, 2>;

    template <class Archive, class Self>
    static void archive_pixels(Archive& bytes, Self& film, std::size_t first, std::size_t count) {
        bytes.raw(film.pixels_.data() + first, count);
        PartSums::archive(bytes, film.parts_, first, count);
        if (!film.geometry_.empty()) {
            bytes.raw(film.geometry_.data() + first, count);
        }
        for (std::size_t i = first; i < first + count && !film.coverage_.empty(); ++i) {
            bytes(film.coverage_[i]);
        }
    }

    /// Adds to what makes the halves: the samples of half a, and how many they are.
    void add_to_half(std::size_t index, const Rgb& radiance);
    std::vector<Layer> part_layers(const Halves& weights) const;
    std::vector<Layer> half_layers(const Halves& weights) const;
    std::vector<Layer> geometry_layers() const;
    std::vector<Layer> object_layers() const;
    std::size_t half_of(std::size_t index) const;
    /// What the pixels of one half are, as they alone tell it.
    std::vector<float> estimates_of_half(const Halves& weights, std::size_t half) const;
    /// Samples of a pixel, as a mean.
    int mean_samples() const;
    Image beauty(const Halves& weights) const;
    /// The variance of one sample of a stage, as one half of the pixels tells it relative to the picture.
    struct StageNoise {
        double variance = 0;  ///< summed over the channels
        double freedom = 0;   ///< samples that tell it, less one of each pixel
        double scatter = 0;   ///< `freedom` times the variance of the estimate `variance` over its square
    };
    /// What one half of the pixels tells of this stage and those before, relative to the picture.
    struct Comparison {
        StageNoise noise;
        double more_light = 0;  ///< of this stage than of those before: of the mean of a channel
        double samples = 0, earlier_samples = 0;
    };
    std::array<Comparison, 2> compare_stages(const Halves& weights) const;
    /// Of the stage at hand, where that of the one before it is known, and the noise of the first one.
    static double stage_weight(double earlier_weight, const StageNoise& first, const Comparison& shown);
    Halves stage_weights() const;

    Pixel& at(const Vec2i& p) { return pixels_[crop_.place_of(p)]; }

    Vec2i full_size_;
    PixelRect crop_;
    FilmLayers layers_;
    std::vector<Pixel> pixels_;
    PartSums parts_;                  ///< those of `layers_`, and behind them what add_to_half() adds to
    std::vector<Geometry> geometry_;  ///< none where it was not asked for
    std::vector<PixelCoverage> coverage_;
    /// Of the stage before this one; none as long as this is the first.
    Halves earlier_weights_{0, 0};
    std::array<StageNoise, 2> first_noise_;
};

}  // namespace wend
