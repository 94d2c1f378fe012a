#include <wend/io/negative_values.h>

#include <wend/core/error.h>

#include <fmt/format.h>

namespace wend {

std::string NegativeValues::warning(float largest) const {
    constexpr float small = 0.1f;
    if (!(lowest_ < 0)) {
        return {};
    }
    const std::string where = fmt::format("voxel ({}, {}, {}) holds {}", voxel_.x, voxel_.y, voxel_.z, lowest_);
    if (lowest_ < -small * largest) {
        throw InputError(where + ": values must be finite and not negative");
    }
    return where + ": values below 0 count as 0";
}

}  // namespace wend
