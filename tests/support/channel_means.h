// Means of pictures by colour channel, over independent renders.
#pragma once

#include <wend/render/render.h>
#include <wend/stats/moments.h>

#include <algorithm>
#include <array>
#include <cstddef>

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
};

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
