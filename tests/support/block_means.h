// Means of pictures and of their square blocks over independent renders, against a reference by classical sampling.
#pragma once

#include <wend/render/render.h>
#include <wend/stats/chi_square.h>
#include <wend/stats/moments.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace wend::test {

struct MeanWithError {
    double mean = 0, error = 0;
};

/// Of the luminance of a picture's blocks line by line, and of all blocks.
struct BlockReference {
    MeanWithError whole;
    std::vector<MeanWithError> blocks;
};

class BlockMeans {
public:
    /// Pixels beyond the last whole block are left out.
    BlockMeans(Vec2i resolution, int block)
        : block_(block),
          columns_(resolution.x / block),
          rows_(resolution.y / block),
          blocks_(static_cast<std::size_t>(columns_ * rows_)) {}

    void add(const Image& image) {
        double total = 0;
        for (int i = 0; i < columns_ * rows_; ++i) {
            double sum = 0;
            for (int k = 0; k < block_ * block_; ++k) {
                sum += luminance(image.at(i % columns_ * block_ + k % block_, i / columns_ * block_ + k / block_));
            }
            blocks_[static_cast<std::size_t>(i)].add(sum / (block_ * block_));
            total += sum / (block_ * block_);
        }
        whole_.add(total / (columns_ * rows_));
    }

    const Moments& whole() const { return whole_; }

    /// The standard error of the difference between the means of all blocks.
    double error(const BlockReference& reference) const {
        return std::hypot(whole_.standard_error(), reference.whole.error);
    }

    /// The probability that the blocks, `scale` times as bright, differ as much from the reference by chance. The
    /// square of a ratio to an estimated error has a heavier tail than that of a normal variable: n - 3 over n - 1 of
    /// n renders brings its mean back to 1.
    double p_value(const BlockReference& reference, double scale = 1) const {
        double sum = 0;
        int used = 0;
        for (std::size_t i = 0; i < blocks_.size(); ++i) {
            const auto [mean, reference_error] = reference.blocks[i];
            const double error = std::hypot(scale * blocks_[i].standard_error(), reference_error);
            if (error > 0) {
                sum += std::pow((scale * blocks_[i].mean() - mean) / error, 2);
                ++used;
            }
        }
        const auto n = static_cast<double>(whole_.count());
        return chi_square_p_value(sum * (n - 3) / (n - 1), used);
    }

private:
    int block_, columns_, rows_;
    Moments whole_;
    std::vector<Moments> blocks_;
};

/// Renders with seeds from `settings.seed` on, until the error of the whole is at most `error`, relative to the
/// reference, or there are `most`. There are at least 12: fewer do not tell their own noise.
inline BlockMeans render_until(const Scene& scene, RenderSettings settings, Vec2i resolution, int block,
                               const BlockReference& reference, double error, int most) {
    constexpr int least = 12;
    BlockMeans means(resolution, block);
    for (int i = 0; i < most && (i < least || means.error(reference) > error * reference.whole.mean); ++i) {
        Film film(resolution, {{0, 0}, resolution});
        render(scene, film, settings);
        means.add(film.beauty());
        ++settings.seed;
    }
    return means;
}

}  // namespace wend::test
