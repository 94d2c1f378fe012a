// Colours of pixels beside the beauty that are weighted by stages as it is: see Film.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace wend {

/// So many colours for each pixel.
class PartSums {
public:
    PartSums() = default;
    PartSums(std::size_t pixels, std::size_t parts) : parts_(parts), sums_(pixels * parts) {}

    std::size_t parts() const { return parts_; }

    void add(std::size_t pixel, std::size_t part, const std::array<double, 3>& colour) {
        Sum& sum = at(pixel, part);
        for (std::size_t c = 0; c < 3; ++c) {
            sum.now[c] += colour[c];
        }
    }
    /// Samples so far count so often from here on.
    void end_stage(std::size_t pixel, double weight) {
        for (std::size_t part = 0; part < parts_; ++part) {
            Sum& sum = at(pixel, part);
            for (std::size_t c = 0; c < 3; ++c) {
                sum.earlier[c] += weight * std::exchange(sum.now[c], 0);
            }
        }
    }
    /// Over all stages, where samples of this one count `weight` times.
    double sum(std::size_t pixel, std::size_t part, std::size_t c, double weight) const {
        const Sum& sum = sums_[pixel * parts_ + part];
        return sum.earlier[c] + weight * sum.now[c];
    }

    /// The sums of some pixels in a row.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& sums, std::size_t pixel, std::size_t count) {
        bytes.raw(sums.sums_.data() + pixel * sums.parts_, count * sums.parts_);
    }

private:
    struct Sum {
        double now[3] = {0, 0, 0};
        double earlier[3] = {0, 0, 0};
    };

    Sum& at(std::size_t pixel, std::size_t part) { return sums_[pixel * parts_ + part]; }

    std::size_t parts_ = 0;
    std::vector<Sum> sums_;
};

}  // namespace wend
