#include <wend/guide/path_records.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <utility>

namespace wend::guide {

namespace {

/// Keeps every k-th of `count` things, with the least k that keeps `most` of them or fewer.
class Thinning {
public:
    Thinning(std::size_t count, std::size_t most)
        : stride_(count <= most ? 1 : (count - 1) / most + 1), left_out_(stride_ - 1) {}

    bool keeps_next() {
        left_out_ = (left_out_ + 1) % stride_;
        return left_out_ == 0;
    }

private:
    std::size_t stride_, left_out_;
};

}  // namespace

Rgb incident_radiance(std::span<const PathVertex> path, std::vector<Rgb>& incident) {
    incident.resize(path.size());
    std::transform(path.begin(), path.end(), incident.begin(), [](const PathVertex& v) { return v.gathered; });
    Rgb brought;
    for (std::size_t i = path.size(); i-- > 0;) {
        const PathVertex& v = path[i];
        WEND_EXPECT(v.parent >= PathVertex::root && v.parent < static_cast<std::int64_t>(i));
        Rgb& before = v.parent == PathVertex::root ? brought : incident[static_cast<std::size_t>(v.parent)];
        before += v.arrival * v.scattering * incident[i];
    }
    return brought;
}

void PathRecords::add(std::span<const PathVertex> path, std::size_t most, bool scattered) {
    WEND_EXPECT(most > 0);
    incident_radiance(path, incident_);
    const auto teaches = [](const PathVertex& v) { return v.density != 0; };
    const auto count = static_cast<std::size_t>(std::count_if(path.begin(), path.end(), teaches));
    Thinning drawn(count, most), mirrored(path.size() - count, most);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const PathVertex& v = path[i];
        if (!(teaches(v) ? drawn : mirrored).keeps_next()) {
            continue;
        }
        ++size_;
        if (scattered) {
            (v.in_volume ? volume_scattered_ : surface_scattered_).push_back(scatter_record_of(v, incident_[i]));
        }
        if (teaches(v)) {
            (v.in_volume ? volume_ : surface_).push_back(record_of(v, incident_[i]));
        }
    }
}

PathRecords PathRecords::joined(std::vector<PathRecords> parts) {
    PathRecords all;
    for (PathRecords& part : parts) {
        all.size_ += std::exchange(part.size_, 0);
    }
    const auto take = [&](auto PathRecords::*kind) {
        std::size_t count = 0;
        for (const PathRecords& part : parts) {
            count += (part.*kind).size();
        }
        (all.*kind).reserve(count);
        for (PathRecords& part : parts) {
            const auto records = std::exchange(part.*kind, {});
            (all.*kind).insert((all.*kind).end(), records.begin(), records.end());
        }
    };
    take(&PathRecords::surface_);
    take(&PathRecords::volume_);
    take(&PathRecords::surface_scattered_);
    take(&PathRecords::volume_scattered_);
    return all;
}

}  // namespace wend::guide
