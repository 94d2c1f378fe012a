// How many samples each pass over the picture takes.
#pragma once

#include <wend/render/render.h>

#include <algorithm>

namespace wend {

/// Plans the passes: doubling while the field learns, then as long as time or samples allow.
class Schedule {
public:
    explicit Schedule(const RenderSettings& settings) : settings_(settings) {}

    /// Samples per pixel of the next pass; 0 at the end.
    int next(int pass, int done, double elapsed) const {
        if (!settings_.passes.empty()) {
            return pass < static_cast<int>(settings_.passes.size()) ? settings_.passes[static_cast<std::size_t>(pass)]
                                                                    : 0;
        }
        constexpr int largest_pass = 32;
        const int wanted = std::min(largest_pass, 1 << std::min(pass, 5));
        if (settings_.seconds <= 0) {
            return std::min(wanted, settings_.samples - done);
        }
        if (done == 0) {
            return 1;
        }
        // What fits into the time that is left, at the pace so far; a last pass may be up to a third short of one
        // sample.
        const double left = (settings_.seconds - elapsed) * done / elapsed;
        return left < 0.67 ? 0 : static_cast<int>(std::clamp(left, 1.0, static_cast<double>(wanted)));
    }

    /// Whether it is known that no pass follows that one, which ends with `done` samples of each pixel.
    bool is_last(int pass, int done) const {
        return settings_.passes.empty() ? settings_.seconds <= 0 && done >= settings_.samples
                                        : pass + 1 >= static_cast<int>(settings_.passes.size());
    }

    double fraction(int done, double elapsed) const {
        if (!settings_.passes.empty()) {
            int total = 0;
            for (const int pass : settings_.passes) {
                total += pass;
            }
            return static_cast<double>(done) / std::max(1, total);
        }
        return std::min(1.0, settings_.seconds > 0 ? elapsed / settings_.seconds
                                                   : static_cast<double>(done) / std::max(1, settings_.samples));
    }

private:
    const RenderSettings& settings_;
};

}  // namespace wend
