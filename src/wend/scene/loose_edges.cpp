#include <wend/scene/loose_edges.h>

#include <wend/core/random.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace wend {
namespace {

constexpr std::size_t most_edges = 1u << 20;
/// Of the meshes' size, and of the largest coordinate, whose rounding it has to cover.
constexpr float same_place = 1e-5f;
constexpr float size_rounding = 1e-6f;

std::uint64_t point_key(const Vec3& p) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 is 0
    return hash_of(bits(p.x), bits(p.y), bits(p.z));
}

/// An edge by the keys of its ends, either way round.
struct EdgeKey {
    std::uint64_t hash;
    int sense;  ///< 1 or -1; 0: no edge

    EdgeKey(std::uint64_t from, std::uint64_t to)
        : hash(from < to ? hash_of(from, to) : hash_of(to, from)),
          sense(from == to  ? 0
                : from < to ? 1
                            : -1) {}
};

/// Calls f(mesh, from, to) for all edges of all triangles.
template <class F>
void for_each_edge(std::span<const OrientedMesh> meshes, F&& f) {
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        for (std::size_t i = 0; i < meshes[m].mesh->triangle_count(); ++i) {
            const std::array<Vec3, 3> p = meshes[m].triangle(i);
            for (std::size_t k = 0; k < 3; ++k) {
                f(static_cast<std::uint32_t>(m), p[k], p[(k + 1) % 3]);
            }
        }
    }
}

/// Adds up the uses of edges, in the order in which they come.
class EdgeCount {
public:
    void add(const EdgeKey& key, const LooseEdge& edge, int surplus, int uses) {
        const auto [found, is_new] = index_.try_emplace(key.hash, edges_.size());
        if (is_new) {
            edges_.push_back(edge);
            edges_.back().surplus = 0;
            edges_.back().uses = 0;
            senses_.push_back(key.sense);
        }
        edges_[found->second].surplus += key.sense == senses_[found->second] ? surplus : -surplus;
        edges_[found->second].uses += uses;
    }

    std::size_t size() const { return edges_.size(); }

    /// Those with a surplus, turned so that it is positive.
    std::vector<LooseEdge> loose() const {
        std::vector<LooseEdge> result;
        for (LooseEdge edge : edges_) {
            if (edge.surplus < 0) {
                std::swap(edge.from, edge.to);
                std::swap(edge.ends[0], edge.ends[1]);
                edge.surplus = -edge.surplus;
            }
            if (edge.surplus > 0) {
                result.push_back(edge);
            }
        }
        return result;
    }

private:
    std::unordered_map<std::uint64_t, std::size_t> index_;
    std::vector<LooseEdge> edges_;
    std::vector<int> senses_;
};

/// The edges whose ends are exactly equal, less those that cancel. Signed sums of hashes find out where anything is
/// left at all, so that only that has to be kept.
std::optional<std::vector<LooseEdge>> exactly_loose(std::span<const OrientedMesh> meshes) {
    constexpr int bucket_bits = 16;
    const auto bucket_of = [](const EdgeKey& key) { return static_cast<std::size_t>(key.hash >> (64 - bucket_bits)); };
    std::vector<std::uint64_t> sums(std::size_t{1} << bucket_bits);
    for_each_edge(meshes, [&](std::uint32_t, const Vec3& from, const Vec3& to) {
        const EdgeKey key(point_key(from), point_key(to));
        sums[bucket_of(key)] += key.hash * static_cast<std::uint64_t>(key.sense);
    });
    if (std::all_of(sums.begin(), sums.end(), [](std::uint64_t sum) { return sum == 0; })) {
        return std::vector<LooseEdge>();
    }
    EdgeCount count;
    for_each_edge(meshes, [&](std::uint32_t mesh, const Vec3& from, const Vec3& to) {
        const EdgeKey key(point_key(from), point_key(to));
        if (key.sense != 0 && sums[bucket_of(key)] != 0 && count.size() <= most_edges) {
            LooseEdge edge{from, to};
            edge.mesh = mesh;
            count.add(key, edge, 1, 1);
        }
    });
    return count.size() <= most_edges ? std::optional(count.loose()) : std::nullopt;
}

/// Numbers points, those in the same place alike.
class Places {
public:
    explicit Places(float tolerance) : tolerance_(tolerance) {}

    std::uint32_t number(const Vec3& p) {
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 q(p.x + ((corner & 1) ? tolerance_ : -tolerance_),
                         p.y + ((corner & 2) ? tolerance_ : -tolerance_),
                         p.z + ((corner & 4) ? tolerance_ : -tolerance_));
            const auto cell = cells_.find(cell_of(q));
            for (std::size_t i = 0; cell != cells_.end() && i < cell->second.size(); ++i) {
                if (length(points_[cell->second[i]] - p) <= tolerance_) {
                    return cell->second[i];
                }
            }
        }
        points_.push_back(p);
        cells_[cell_of(p)].push_back(static_cast<std::uint32_t>(points_.size() - 1));
        return static_cast<std::uint32_t>(points_.size() - 1);
    }

private:
    /// Cells are wider than what number() looks at around a point.
    std::uint64_t cell_of(const Vec3& p) const {
        const auto index = [&](float x) {
            return static_cast<std::int64_t>(
                std::floor(static_cast<double>(x) / (4 * static_cast<double>(tolerance_))));
        };
        return hash_of(index(p.x), index(p.y), index(p.z));
    }

    float tolerance_;
    std::vector<Vec3> points_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

std::array<Vec3, 3> OrientedMesh::triangle(std::size_t i) const {
    std::array<Vec3, 3> p = {mesh->vertex(i, 0), mesh->vertex(i, 1), mesh->vertex(i, 2)};
    bool turn = reversed;
    if (!mesh->normals.empty()) {
        const std::uint32_t* corners = &mesh->indices[3 * i];
        const Vec3 normal = mesh->normals[corners[0]] + mesh->normals[corners[1]] + mesh->normals[corners[2]];
        turn = turn != (dot(cross(p[1] - p[0], p[2] - p[0]), normal) < 0);
    }
    if (turn) {
        std::swap(p[1], p[2]);
    }
    return p;
}

std::optional<std::vector<LooseEdge>> loose_edges(std::span<const OrientedMesh> meshes) {
    std::optional<std::vector<LooseEdge>> exact = exactly_loose(meshes);
    if (!exact || exact->empty()) {
        return exact;
    }
    Box3 box;
    float largest = 0;
    for (const OrientedMesh& m : meshes) {
        for (const Vec3& p : m.mesh->positions) {
            box.extendBy(p);
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        }
    }
    const Vec3 size = box.size();
    const float tolerance = std::max(same_place * std::max({size.x, size.y, size.z}), size_rounding * largest);
    Places places(std::max(tolerance, std::numeric_limits<float>::min()));
    EdgeCount count;
    for (LooseEdge& edge : *exact) {
        edge.ends = {places.number(edge.from), places.number(edge.to)};
        const EdgeKey key(edge.ends[0], edge.ends[1]);
        if (key.sense != 0) {
            count.add(key, edge, edge.surplus, edge.uses);
        }
    }
    return count.loose();
}

}  // namespace wend
