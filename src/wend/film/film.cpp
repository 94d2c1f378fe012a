#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/film/film.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

std::size_t checked_size(const Vec2i& full, const PixelRect& crop) {
    if (full.x <= 0 || full.y <= 0) {
        throw InputError("a film of " + std::to_string(full.x) + " x " + std::to_string(full.y) +
                         " pixels: both must be positive");
    }
    if (crop.min.x < 0 || crop.min.y < 0 || crop.max.x > full.x || crop.max.y > full.y || crop.width() <= 0 ||
        crop.height() <= 0) {
        throw InputError("the crop window is empty or outside the picture");
    }
    const auto pixels = static_cast<std::int64_t>(crop.width()) * crop.height();
    if (pixels > Film::max_pixels) {
        throw InputError("a film of " + std::to_string(crop.width()) + " x " + std::to_string(crop.height()) +
                         " pixels is more than Wend holds in memory (" + std::to_string(Film::max_pixels) + " pixels)");
    }
    return static_cast<std::size_t>(pixels);
}

}  // namespace

Film::Film(const Vec2i& full_size, const PixelRect& crop)
    : full_size_(full_size), crop_(crop), pixels_(checked_size(full_size, crop)) {
}

void Film::add(const Vec2i& pixel, const FilmSample& sample) {
    Pixel& p = at(pixel);
    for (int c = 0; c < 3; ++c) {
        const double v = sample.radiance[c];
        p.sum[c] += v;
        p.squares[c] += v * v;
        p.albedo[c] += sample.albedo[c];
        p.normal[c] += sample.normal[c];
    }
    p.depth += sample.depth;
    ++p.count;
}

void Film::reject(const Vec2i& pixel) {
    ++at(pixel).count;
}

void Film::take_back(const Film& earlier) {
    WEND_EXPECT(earlier.crop_ == crop_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        Pixel& p = pixels_[i];
        const Pixel& e = earlier.pixels_[i];
        for (int c = 0; c < 3; ++c) {
            p.sum[c] -= e.sum[c];
            p.squares[c] -= e.squares[c];
            p.albedo[c] -= e.albedo[c];
            p.normal[c] -= e.normal[c];
        }
        p.depth -= e.depth;
        p.count -= e.count;
    }
}

Image Film::beauty() const {
    Image image(crop_.width(), crop_.height());
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Pixel& p = pixels_[i];
        const double scale = p.count > 0 ? 1.0 / p.count : 0.0;
        image.pixels[i] = {static_cast<float>(p.sum[0] * scale), static_cast<float>(p.sum[1] * scale),
                           static_cast<float>(p.sum[2] * scale)};
    }
    return image;
}

Picture Film::picture() const {
    Picture picture;
    picture.image = beauty();
    picture.offset = crop_.min;
    picture.full_size = full_size_;
    Layer albedo{"albedo", {"R", "G", "B"}, {}};
    Layer normal{"normal", {"X", "Y", "Z"}, {}};
    Layer depth{"depth", {"Z"}, {}};
    Layer samples{"samples", {"N"}, {}};
    Layer variance{"variance", {"R", "G", "B"}, {}};
    for (const Pixel& p : pixels_) {
        const float n = static_cast<float>(std::max(p.count, 1u));
        for (int c = 0; c < 3; ++c) {
            albedo.values.push_back(p.albedo[c] / n);
            normal.values.push_back(p.normal[c] / n);
            const double mean = p.sum[c] / n;
            const double spread = p.count > 1 ? std::max(0.0, p.squares[c] / n - mean * mean) / (n - 1.0) : 0.0;
            variance.values.push_back(static_cast<float>(spread));
        }
        depth.values.push_back(p.depth / n);
        samples.values.push_back(static_cast<float>(p.count));
    }
    picture.layers = {std::move(albedo), std::move(normal), std::move(depth), std::move(samples), std::move(variance)};
    return picture;
}

double Film::relative_noise() const {
    double total = 0;
    for (const Pixel& p : pixels_) {
        total += p.count > 0 ? (p.sum[0] + p.sum[1] + p.sum[2]) / p.count : 0.0;
    }
    const double floor = 0.1 * total / static_cast<double>(pixels_.size());
    double sum = 0;
    for (const Pixel& p : pixels_) {
        if (p.count < 2) {
            continue;
        }
        const double n = p.count;
        double variance = 0;
        double mean = 0;
        for (int c = 0; c < 3; ++c) {
            const double m = p.sum[c] / n;
            variance += std::max(0.0, p.squares[c] / n - m * m) / (n - 1);
            mean += m;
        }
        const double scale = std::max(mean, floor);
        sum += scale > 0 ? 3 * variance / (scale * scale) : 0.0;
    }
    return std::sqrt(sum / static_cast<double>(pixels_.size()));
}

}  // namespace wend
