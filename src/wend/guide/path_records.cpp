#include <wend/guide/path_records.h>

#include <wend/core/contracts.h>

#include <algorithm>

namespace wend::guide {

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

void PathRecords::add(std::span<const PathVertex> path, std::size_t most) {
    WEND_EXPECT(most > 0);
    incident_radiance(path, incident_);
    const auto teaches = [](const PathVertex& v) { return v.density != 0; };
    const auto count = static_cast<std::size_t>(std::count_if(path.begin(), path.end(), teaches));
    const std::size_t stride = count <= most ? 1 : (count - 1) / most + 1;
    std::size_t left_out = stride - 1;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const PathVertex& v = path[i];
        if (teaches(v) && ++left_out == stride) {
            left_out = 0;
            (v.in_volume ? volume_ : surface_).push_back(record_of(v, incident_[i]));
        }
    }
}

void PathRecords::append(const PathRecords& other) {
    surface_.insert(surface_.end(), other.surface_.begin(), other.surface_.end());
    volume_.insert(volume_.end(), other.volume_.begin(), other.volume_.end());
}

}  // namespace wend::guide
