#include <wend/scene/media_at.h>

#include <wend/core/random.h>
#include <wend/scene/scene.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace wend {
namespace {

/// What is nearer than this, over its size and distance from the origin, touches.
constexpr float touching = 1e-4f;

/// Sets that are joined (tarjan1975).
class DisjointSets {
public:
    std::uint32_t add() {
        parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
        return parent_.back();
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) {
            i = parent_[i] = parent_[parent_[i]];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[find(b)] = find(a); }

private:
    std::vector<std::uint32_t> parent_;
};

std::uint64_t key_of(const Vec3& p) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 is 0
    return hash_of(bits(p.x), bits(p.y), bits(p.z));
}

/// Whether boxes touch, with room for rounding.
bool touch(const Box3& a, const Box3& b) {
    const auto apart = [](float max_a, float min_b, float size) { return min_b - max_a > touching * size; };
    for (int k = 0; k < 3; ++k) {
        const float size = std::max({std::abs(a.min[k]), std::abs(a.max[k]), std::abs(b.min[k]), std::abs(b.max[k])});
        if (apart(a.max[k], b.min[k], size) || apart(b.max[k], a.min[k], size)) {
            return false;
        }
    }
    return true;
}

bool contains(const Box3& outer, const Box3& inner) {
    for (int k = 0; k < 3; ++k) {
        if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) {
            return false;
        }
    }
    return true;
}

float volume(const Box3& box) {
    const Vec3 size = box.size();
    return size.x * size.y * size.z;
}

/// Finds the closed parts of the boundaries in one object definition, or in the world.
class Parts {
public:
    /// What is on the two sides of a part, which may be made of several kinds of surface.
    struct Part {
        Box3 box;
        std::vector<MediumId> interiors, exteriors;
    };

    Parts(const SceneDescription& scene, const std::vector<int>& surfaces, std::vector<std::vector<std::int32_t>>& of)
        : scene_(scene) {
        for (const int s : surfaces) {
            if (scene.surfaces[static_cast<std::size_t>(s)].bounds_medium()) {
                add(s);
            }
        }
        join_at_open_edges();
        number(of);
    }

    const std::vector<Part>& list() const { return list_; }

private:
    /// An edge's place, and how many times more often triangles have it one way round than the other.
    struct Edge {
        std::uint64_t key;
        int surplus;
        std::uint32_t set;
    };

    void add(int s) {
        const Surface& surface = scene_.surfaces[static_cast<std::size_t>(s)];
        std::vector<std::uint32_t>& sets = sets_.emplace_back(s, std::vector<std::uint32_t>()).second;
        const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get());
        if (!mesh) {
            sets.push_back(sets_of_all_.add());
            const auto* sphere = std::get_if<Sphere>(&std::get<Quadric>(*surface.shape).shape);
            if (!sphere || !sphere->is_full()) {
                edges_.push_back({0, 1, sets.back()});
            }
            return;
        }
        // By the indices of the corners; edges that are then used only one way round are open.
        std::vector<std::uint32_t> of_vertex(mesh->positions.size(), ~0u);
        for (std::size_t i = 0; i < mesh->triangle_count(); ++i) {
            const std::uint32_t set = sets_of_all_.add();
            sets.push_back(set);
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& at_vertex = of_vertex[mesh->indices[3 * i + k]];
                if (at_vertex == ~0u) {
                    at_vertex = set;
                } else {
                    sets_of_all_.join(at_vertex, set);
                }
            }
        }
        std::unordered_map<std::uint64_t, std::pair<int, std::uint32_t>> uses;
        const auto pair = [](std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; };
        for (std::size_t i = 0; i < mesh->triangle_count(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = mesh->indices[3 * i + k], to = mesh->indices[3 * i + (k + 1) % 3];
                auto& [surplus, set] = uses[from < to ? pair(from, to) : pair(to, from)];
                surplus += from < to ? 1 : -1;
                set = sets[i];
            }
        }
        for (const auto& [edge, use] : uses) {
            if (use.first != 0) {
                const std::uint64_t a = key_of(mesh->positions[edge >> 32]);
                const std::uint64_t b = key_of(mesh->positions[edge & ~0u]);
                const bool turned = surface.flip_normal && mesh->normals.empty();
                const int surplus = turned == (a < b) ? -use.first : use.first;
                edges_.push_back({a < b ? hash_of(a, b) : hash_of(b, a), a == b ? 0 : surplus, use.second});
            }
        }
    }

    /// Those in the same place go on into each other: faces that are shapes of their own, triangles without indices.
    void join_at_open_edges() {
        std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.key < b.key; });
        for (std::size_t i = 1; i < edges_.size(); ++i) {
            if (edges_[i].key == edges_[i - 1].key) {
                sets_of_all_.join(edges_[i - 1].set, edges_[i].set);
            }
        }
        for (std::size_t i = 0; i < edges_.size();) {
            int surplus = 0;
            const std::size_t first = i;
            for (; i < edges_.size() && edges_[i].key == edges_[first].key; ++i) {
                surplus += edges_[i].surplus;
            }
            if (surplus != 0) {
                open_.insert(sets_of_all_.find(edges_[first].set));
            }
        }
    }

    void number(std::vector<std::vector<std::int32_t>>& of) {
        std::unordered_map<std::uint32_t, std::int32_t> numbers;
        const auto add_once = [](std::vector<MediumId>& media, MediumId id) {
            if (std::find(media.begin(), media.end(), id) == media.end()) {
                media.push_back(id);
            }
        };
        for (const auto& [s, sets] : sets_) {
            const Surface& surface = scene_.surfaces[static_cast<std::size_t>(s)];
            std::vector<std::int32_t>& parts = of[static_cast<std::size_t>(s)];
            for (std::size_t i = 0; i < sets.size(); ++i) {
                if (open_.contains(sets_of_all_.find(sets[i]))) {
                    parts.push_back(MediumRegions::none);
                    continue;
                }
                const auto [found, is_new] =
                    numbers.try_emplace(sets_of_all_.find(sets[i]), static_cast<std::int32_t>(list_.size()));
                if (is_new) {
                    list_.emplace_back();
                }
                Part& part = list_[static_cast<std::size_t>(found->second)];
                add_once(part.interiors, surface.interior);
                add_once(part.exteriors, surface.exterior);
                if (const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get())) {
                    for (const Vec3& corner : mesh->triangle(i, 0)) {
                        part.box.extendBy(corner);
                    }
                } else {
                    part.box.extendBy(bounds(*surface.shape));
                }
                parts.push_back(found->second);
            }
            if (!parts.empty() && std::count(parts.begin(), parts.end(), parts[0]) == std::ssize(parts)) {
                parts.assign(1, parts[0]);
            }
        }
    }

    const SceneDescription& scene_;
    DisjointSets sets_of_all_;
    std::vector<std::pair<int, std::vector<std::uint32_t>>> sets_;  // by surface, of its primitives
    std::vector<Edge> edges_;                                       // not closed by what shares their indices
    std::unordered_set<std::uint32_t> open_;                        // sets that have edges where nothing goes on
    std::vector<Part> list_;
};

using Part = Parts::Part;

Box3 moved(const Box3& box, const Transform& by) {
    Box3 result;
    for (int corner = 0; corner < 8; ++corner) {
        result.extendBy(by.point(Vec3(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                      corner & 4 ? box.max.z : box.min.z)));
    }
    return result;
}

/// Whether all of the surfaces of the inner part say that they lie in what is within the outer one.
bool lies_within(const Part& inner, const Part& outer) {
    return inner.exteriors.size() == 1 && outer.interiors.size() == 1 && inner.exteriors[0] == outer.interiors[0] &&
           inner.exteriors[0] != vacuum && contains(outer.box, inner.box);
}

/// Whether any two of the parts do not tell all by themselves.
bool need_telling_apart(const std::vector<Part>& parts) {
    std::vector<const Part*> sorted;
    for (const Part& part : parts) {
        sorted.push_back(&part);
    }
    std::sort(sorted.begin(), sorted.end(), [](const Part* a, const Part* b) { return a->box.min.x < b->box.min.x; });
    std::vector<const Part*> open;  // those that reach to the one at hand
    for (const Part* part : sorted) {
        std::erase_if(open, [&](const Part* before) {
            return part->box.min.x - before->box.max.x >
                   touching * std::max(std::abs(part->box.min.x), std::abs(before->box.max.x));
        });
        for (const Part* before : open) {
            if (touch(before->box, part->box) && !lies_within(*before, *part) && !lies_within(*part, *before)) {
                return true;
            }
        }
        open.push_back(part);
    }
    return false;
}

}  // namespace

MediumRegions::MediumRegions(const SceneDescription& scene) {
    std::vector<std::vector<std::int32_t>> parts_of(scene.surfaces.size());
    const Parts in_world(scene, scene.world_surfaces, parts_of);
    std::vector<Part> regions = in_world.list();
    std::vector<std::int32_t> first{0};
    std::vector<std::vector<Part>> in_objects;
    for (const ObjectDefinition& object : scene.objects) {
        in_objects.push_back(Parts(scene, object.surfaces, parts_of).list());
    }
    bool is_moving = scene.camera.is_moving() && !regions.empty();
    for (const Surface& surface : scene.surfaces) {
        is_moving = is_moving || (surface.bounds_medium() && wend::is_moving(*surface.shape));
    }
    for (const Instance& instance : scene.instances) {
        first.push_back(static_cast<std::int32_t>(regions.size()));
        for (Part part : in_objects[static_cast<std::size_t>(instance.object)]) {
            part.box = moved(part.box, instance.world_from_object.start());
            regions.push_back(std::move(part));
            is_moving = is_moving || scene.camera.is_moving() || instance.world_from_object.is_moving();
        }
    }
    if (!is_moving && !need_telling_apart(regions)) {
        return;
    }
    std::vector<std::int32_t> order(regions.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return volume(regions[static_cast<std::size_t>(a)].box) < volume(regions[static_cast<std::size_t>(b)].box);
    });
    rank_.resize(regions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        rank_[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
        const std::vector<MediumId>& media = regions[static_cast<std::size_t>(order[i])].interiors;
        media_of_parts_.insert(media_of_parts_.end(), media.begin(), media.end());
        first_part_.push_back(static_cast<std::int32_t>(media_of_parts_.size()));
    }
    parts_ = std::move(parts_of);
    first_ = std::move(first);
}

int MediumRegions::region(const SurfaceElement& element) const {
    const std::vector<std::int32_t>& parts = parts_[element.surface];
    const std::int32_t part = parts.size() == 1 ? parts[0] : parts[element.primitive];
    if (part == none) {
        return none;
    }
    return rank_[static_cast<std::size_t>(first_[static_cast<std::size_t>(1 + element.instance)] + part)];
}

void MediumRegions::cross(MediumState& state, const Surface& surface, const SurfaceElement& element,
                          bool inwards) const {
    const MediumId beyond = inwards ? surface.interior : surface.exterior;
    const int r = is_empty() ? none : region(element);
    if (r == none) {
        state.id = beyond;
        return;
    }
    const std::int32_t first = first_part_[static_cast<std::size_t>(r)];
    const std::int32_t last = first_part_[static_cast<std::size_t>(r) + 1];
    const auto media = media_of_parts_.begin();
    const auto part = static_cast<std::int32_t>(std::find(media + first, media + last, beyond) - media);
    auto& inside = state.inside_;
    const auto place = std::find_if(inside.begin(), inside.end(),
                                    [&](std::int32_t i) { return i == MediumState::nowhere || i >= first; });
    bool is_in = place != inside.end() && *place >= first && *place < last;
    // A wall within a region has another part of it on its other side.
    const bool stays = inwards || (beyond != vacuum && last - first > 1 && part < last);
    if (stays && !is_in && place != inside.end()) {
        std::move_backward(place, inside.end() - 1, inside.end());
        is_in = true;
    }
    if (is_in && stays) {
        *place = part;
    } else if (is_in) {
        std::move(place + 1, inside.end(), place);
        inside.back() = MediumState::nowhere;
    }
    state.id = inside[0] == MediumState::nowhere ? beyond : media[inside[0]];
}

}  // namespace wend
