#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/film/picture.h>

#include <cstdint>
#include <vector>

namespace wend {

/// What one camera sample leaves on the film.
struct FilmSample {
    Rgb radiance;
    Rgb albedo;
    Vec3 normal{0, 0, 0};
    float depth = 0;  ///< distance to the first vertex; 0 where there is none
};

/// A rectangle of pixels, the upper end exclusive.
struct PixelRect {
    Vec2i min{0, 0};
    Vec2i max{0, 0};

    int width() const { return max.x - min.x; }
    int height() const { return max.y - min.y; }
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// Sums of samples, pixel by pixel. Two threads must not add to the same pixel.
class Film {
public:
    /// Throws InputError if the crop window is empty, outside the picture, or larger than max_pixels.
    Film(const Vec2i& full_size, const PixelRect& crop);

    const Vec2i& full_size() const { return full_size_; }
    const PixelRect& crop() const { return crop_; }

    /// Adds a finite sample; `pixel` is in coordinates of the full picture.
    void add(const Vec2i& pixel, const FilmSample& sample);
    /// Counts a sample that was not a number: it adds nothing, but is not forgotten.
    void reject(const Vec2i& pixel);

    /// Takes back all samples of an earlier state of this film.
    void take_back(const Film& earlier);

    Image beauty() const;
    /// Beauty and the layers albedo, normal, depth, samples, and variance (of the pixel's mean, from the scatter of its
    /// samples; with stratified samples an overestimate).
    Picture picture() const;
    /// Root mean square of the relative standard error of pixels, their luminance measured against at least a tenth of
    /// the mean.
    double relative_noise() const;

    static constexpr std::int64_t max_pixels = std::int64_t{1} << 27;

private:
    struct Pixel {
        double sum[3] = {0, 0, 0};
        double squares[3] = {0, 0, 0};
        float albedo[3] = {0, 0, 0};
        float normal[3] = {0, 0, 0};
        float depth = 0;
        std::uint32_t count = 0;
    };

    Pixel& at(const Vec2i& p) {
        return pixels_[static_cast<std::size_t>(p.y - crop_.min.y) * static_cast<std::size_t>(crop_.width()) +
                       static_cast<std::size_t>(p.x - crop_.min.x)];
    }

    Vec2i full_size_;
    PixelRect crop_;
    std::vector<Pixel> pixels_;
};

}  // namespace wend
