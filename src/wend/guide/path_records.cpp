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
    cost_.assign(path.size(), 1);
    for (std::size_t i = path.size(); i-- > 0;) {
        if (path[i].parent != PathVertex::root) {
            cost_[static_cast<std::size_t>(path[i].parent)] += cost_[i];
        }
    }
    const std::size_t stride = path.size() <= most ? 1 : (path.size() - 1) / most + 1;
    for (std::size_t i = stride - 1; i < path.size(); i += stride) {
        const PathVertex& v = path[i];
        (v.in_volume ? volume_scattered_ : surface_scattered_).push_back(scatter_record_of(v, incident_[i], cost_[i]));
        if (v.density != 0) {
            (v.in_volume ? volume_ : surface_).push_back(record_of(v, incident_[i]));
        }
    }
}

void PathRecords::append(const PathRecords& other) {
    const auto extend = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    extend(surface_, other.surface_);
    extend(volume_, other.volume_);
    extend(surface_scattered_, other.surface_scattered_);
    extend(volume_scattered_, other.volume_scattered_);
}

}  // namespace wend::guide
