#include <wend/io/mitsuba/vol_file.h>

#include <wend/core/error.h>
#include <wend/io/bytes.h>
#include <wend/io/gzip.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace wend::mitsuba {

float VoxelData::at(const Vec3& p, int channel) const {
    int low[3], high[3];
    float t[3];
    for (int axis = 0; axis < 3; ++axis) {
        const float middle = static_cast<float>(size[axis] - 1);
        const float x = std::clamp(p[axis] * static_cast<float>(size[axis]) - 0.5f, 0.0f, middle);
        low[axis] = std::min(static_cast<int>(x), std::max(size[axis] - 2, 0));
        high[axis] = std::min(low[axis] + 1, size[axis] - 1);
        t[axis] = x - static_cast<float>(low[axis]);
    }
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const bool x = corner & 1, y = corner & 2, z = corner & 4;
        const float weight = (x ? t[0] : 1 - t[0]) * (y ? t[1] : 1 - t[1]) * (z ? t[2] : 1 - t[2]);
        sum += weight * at(x ? high[0] : low[0], y ? high[1] : low[1], z ? high[2] : low[2], channel);
    }
    return sum;
}

VoxelData read_vol(const std::filesystem::path& file) {
    const Place place{file.string(), 0, 0};
    const std::string content = read_file(file);
    Bytes bytes(content, place);
    constexpr char signature[] = {'V', 'O', 'L', 3};
    if (content.size() < sizeof signature || std::memcmp(bytes.take(sizeof signature).data(), signature, 4) != 0) {
        throw InputError(place, "this is no volume file of version 3");
    }
    constexpr std::int32_t floats = 1, largest_side = 1 << 20;
    if (const auto type = bytes.take<std::int32_t>(); type != floats) {
        throw InputError(place, fmt::format("only volumes of 32-bit floats (1) can be read, not of type {}", type));
    }
    VoxelData data;
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        data.size[axis] = bytes.take<std::int32_t>();
        if (data.size[axis] < 1 || data.size[axis] > largest_side) {
            throw InputError(place, fmt::format("{} voxels along an axis are out of range", data.size[axis]));
        }
        count *= data.size[axis];
    }
    data.channels = bytes.take<std::int32_t>();
    if (data.channels != 1 && data.channels != 3) {
        throw InputError(place, fmt::format("only volumes of 1 or 3 channels can be read, not of {}", data.channels));
    }
    for (float* corner :
         {&data.box_min.x, &data.box_min.y, &data.box_min.z, &data.box_max.x, &data.box_max.y, &data.box_max.z}) {
        *corner = bytes.take<float>();
    }
    count *= data.channels;
    if (count > static_cast<double>(bytes.left() / sizeof(float))) {
        throw InputError(place, "the file is truncated");
    }
    data.values.resize(static_cast<std::size_t>(count));
    const std::size_t size = data.values.size() * sizeof(float);
    std::memcpy(data.values.data(), bytes.take(size).data(), size);
    if (!std::all_of(data.values.begin(), data.values.end(), [](float v) { return std::isfinite(v); })) {
        throw InputError(place, "a voxel holds no finite number");
    }
    return data;
}

}  // namespace wend::mitsuba
