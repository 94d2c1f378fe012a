// Means of pictures by colour channel, over independent renders.
#pragma once

#include <tests/support/kept_means.h>

#include <wend/render/render.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wend::test {

struct ChannelMeans {
    std::array<Moments, 3> channels;

    const Moments& operator[](int channel) const { return channels[static_cast<std::size_t>(channel)]; }

    void add(const Image& image) {
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (const Rgb& pixel : image.pixels) {
                sum += static_cast<double>(pixel[c]);
            }
            channels[static_cast<std::size_t>(c)].add(sum / static_cast<double>(image.pixels.size()));
        }
    }

    /// The largest standard error of a channel over scale(its mean).
    template <class Scale>
    double worst_error(const Scale& scale) const {
        double worst = 0;
        for (const Moments& m : channels) {
            worst = std::max(worst, m.standard_error() / scale(m.mean()));
        }
        return worst;
    }

    std::vector<KnownMean> known() const {
        std::vector<KnownMean> means;
        for (const Moments& m : channels) {
            means.push_back({m.mean(), m.standard_error()});
        }
        return means;
    }
    /// Of the difference to what is known.
    double error(const std::vector<KnownMean>& known, int channel) const {
        return std::hypot((*this)[channel].standard_error(), known[static_cast<std::size_t>(channel)].standard_error);
    }
    /// Whether a bias of this size would be seen in each channel, at four standard errors.
    bool would_see(double bias, const std::vector<KnownMean>& known) const {
        bool seen = true;
        for (int c = 0; c < 3; ++c) {
            seen &= 4 * error(known, c) < bias * known[static_cast<std::size_t>(c)].mean;
        }
        return seen;
    }
};

/// The means of picture(seed), with seeds from 1 on, until a bias of this size would be seen or there are `most`. There
/// are at least 16: fewer do not tell their own noise. (Eight were once as near to each other as a third of it.)
template <class Picture>
ChannelMeans means_until_seen(double bias, const std::vector<KnownMean>& known, int most, const Picture& picture) {
    constexpr int least = 16;
    ChannelMeans means;
    for (int i = 0; i < most && (i < least || !means.would_see(bias, known)); ++i) {
        means.add(picture(static_cast<std::uint64_t>(1 + i)));
    }
    return means;
}

/// That means are right, and known well enough to see such a bias.
inline void expect_known(const ChannelMeans& means, const std::vector<KnownMean>& known, double bias) {
    for (int c = 0; c < 3; ++c) {
        const double right = known[static_cast<std::size_t>(c)].mean;
        EXPECT_TRUE(agrees(means[c].mean() - right, means.error(known, c), 0, 4))
            << "channel " << c << ": " << means[c].mean() << " +- " << means.error(known, c) << ", not " << right;
    }
    EXPECT_TRUE(means.would_see(bias, known)) << "too few samples to see a bias of " << bias;
}

/// Square pictures with seeds from 1 on, until the worst error is at most `error` or there are `most`. There are at
/// least 16: fewer do not tell their own noise.
template <class Scale>
ChannelMeans render_until(const Scene& scene, RenderSettings settings, int resolution, double error, int most,
                          const Scale& scale) {
    constexpr int least = 16;
    ChannelMeans means;
    for (int i = 0; i < most && (i < least || means.worst_error(scale) > error); ++i) {
        settings.seed = static_cast<std::uint64_t>(1 + i);
        Film film({resolution, resolution}, {{0, 0}, {resolution, resolution}});
        render(scene, film, settings);
        means.add(film.beauty());
    }
    return means;
}

}  // namespace wend::test
