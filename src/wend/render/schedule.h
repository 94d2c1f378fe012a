// How many samples each pass over the picture takes.
#pragma once

#include <wend/core/error.h>
#include <wend/render/render.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

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
            // A small rest is no pass of its own, which would cost more than it brings.
            const int left = settings_.samples - done;
            return left < wanted + wanted / 2 ? left : wanted;
        }
        if (done == 0) {
            return 1;
        }
        // What fits into the time that is left, at the pace so far. Where the next pass would be the last, half of it:
        // the pace may change, and a pass that is cut leaves a part of the picture with fewer samples.
        constexpr double short_time = 1;
        const double left = settings_.seconds - elapsed;
        if (left < tolerance()) {
            return 0;
        }
        const double fitting = left * done / elapsed;
        const double next = fitting < 2 * wanted && left > short_time ? std::ceil(fitting / 2) : fitting;
        return static_cast<int>(std::clamp(next, 1.0, static_cast<double>(wanted)));
    }

    /// Throws InputError where passes are to be repeated, and those that a render has had, and the one that it is in
    /// (0: in none), are others.
    void require(std::vector<int> had, int at_hand) const {
        if (at_hand > 0) {
            had.push_back(at_hand);
        }
        const std::vector<int>& wanted = settings_.passes;
        if (!wanted.empty() && (had.size() > wanted.size() || !std::equal(had.begin(), had.end(), wanted.begin()))) {
            throw InputError(
                fmt::format("{} are its passes, and those to be repeated do not begin so", fmt::join(had, ",")));
        }
    }

    /// Whether time ends the render.
    bool is_timed() const { return settings_.seconds > 0 && settings_.passes.empty(); }

    /// Samples of each pixel in the end; no less than any number of them where time ends the render.
    int total() const {
        if (settings_.passes.empty()) {
            return is_timed() ? std::numeric_limits<int>::max() : settings_.samples;
        }
        return std::accumulate(settings_.passes.begin(), settings_.passes.end(), 0);
    }

    /// Whether it is known that no pass follows that one, which ends with `done` samples of each pixel.
    bool is_last(int pass, int done) const {
        return settings_.passes.empty() ? settings_.seconds <= 0 && done >= settings_.samples
                                        : pass + 1 >= static_cast<int>(settings_.passes.size());
    }

    /// Of the whole, where each pixel has so many samples as a mean.
    double fraction(double done, double elapsed) const {
        return std::min(1.0, is_timed() ? elapsed / settings_.seconds : done / std::max(1, total()));
    }

private:
    /// Less time is not worth another pass.
    double tolerance() const { return std::min(0.25, 0.02 * settings_.seconds); }

    const RenderSettings& settings_;
};

}  // namespace wend
