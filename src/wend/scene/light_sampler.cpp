#include <wend/scene/light_sampler.h>

#include <wend/core/vector.h>
#include <wend/scene/moving_light.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace wend {

PowerLightSampler::PowerLightSampler(std::span<const Light> lights, float scene_radius) {
    std::vector<float> powers;
    powers.reserve(lights.size());
    for (const Light& light : lights) {
        powers.push_back(light_power(light, scene_radius));
    }
    table_ = AliasTable(powers);
}

ChosenLight PowerLightSampler::sample(const LightReceiver&, float u) const {
    if (table_.size() == 0) {
        return {};
    }
    const int i = table_.sample(u);
    return {i, table_.probability(i)};
}

float PowerLightSampler::probability(const LightReceiver&, int light) const {
    return table_.probability(light);
}

namespace {

/// cos(max(0, a - b)) for angles given by their sines and cosines.
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

}  // namespace

float TreeLightSampler::Bounds::importance(const LightReceiver& receiver) const {
    const Vec3 centre = box.center();
    const Vec3 to_receiver = receiver.position - centre;
    const float radius2 = 0.25f * length_squared(box.size());
    // Near or inside the box distance says little: never let it fall below half the box's diagonal.
    const float d2 = std::max(length_squared(to_receiver), std::max(radius2, 1e-30f));
    const float true_d2 = length_squared(to_receiver);
    const Vec3 w = true_d2 > 0 ? to_receiver / std::sqrt(true_d2) : axis;

    // The angle that the box subtends from the receiver.
    const float sin2_b = true_d2 > radius2 ? radius2 / true_d2 : 1.0f;
    const float cos_b = true_d2 > radius2 ? std::sqrt(1 - sin2_b) : -1.0f;
    const float sin_b = cos_b < 0 ? 0.0f : std::sqrt(sin2_b);

    const float cos_w = two_sided ? abs_dot(axis, w) : dot(axis, w);
    const float sin_w = safe_sqrt(1 - cos_w * cos_w);
    const float sin_o = safe_sqrt(1 - cos_o * cos_o);
    const float cos_x = cos_of_difference(sin_w, cos_w, sin_o, cos_o);
    const float sin_x = sin_of_difference(sin_w, cos_w, sin_o, cos_o);
    const float cos_prime = cos_of_difference(sin_x, cos_x, sin_b, cos_b);
    if (cos_prime <= cos_e) {
        return 0;
    }
    float value = power * cos_prime / d2;
    if (length_squared(receiver.normal) > 0) {
        const float cos_i = abs_dot(w, receiver.normal);
        const float sin_i = safe_sqrt(1 - cos_i * cos_i);
        value *= std::max(0.0f, cos_of_difference(sin_i, cos_i, sin_b, cos_b));
    }
    return value;
}

namespace {

/// Where the z axis of a light's own space points to in the world, if directions keep their angles.
std::optional<Vec3> axis_of(const AffineMap& light_from_world) {
    const Vec3 x = light_from_world.transposed_vector({1, 0, 0}), y = light_from_world.transposed_vector({0, 1, 0}),
               z = light_from_world.transposed_vector({0, 0, 1});
    const float size = length_squared(z), same = 1e-4f * size;
    const bool keeps_angles = std::abs(length_squared(x) - size) < same && std::abs(length_squared(y) - size) < same &&
                              std::abs(dot(x, y)) < same && std::abs(dot(y, z)) < same && std::abs(dot(z, x)) < same;
    return keeps_angles ? std::optional(normalize(z)) : std::nullopt;
}

}  // namespace

TreeLightSampler::Bounds TreeLightSampler::bounds_of(const Light& light) {
    struct Make {
        Bounds operator()(const PointLight& l) const {
            return {Box3(l.position), {0, 0, 1}, -1, 0, 4 * pi * mean(l.intensity), false};
        }
        Bounds operator()(const SpotLight& l) const {
            return in_cone(l.position, l.light_from_world, l.cos_inner, l.cos_outer, mean(l.intensity));
        }
        Bounds operator()(const ProjectionLight& l) const {
            return in_cone(l.position, l.light_from_world, corner_cosine(l), corner_cosine(l),
                           mean(l.intensity * l.picture->mean_colour()));
        }
        Bounds operator()(const GoniometricLight& l) const {
            return {Box3(l.position), {0, 0, 1}, -1, 0, light_power(l, 0), false};
        }
        Bounds operator()(const TriangleLight& l) const {
            return of_area_light(extent_over_time(l), light_power(l, 0), l.two_sided);
        }
        Bounds operator()(const QuadricLight& l) const {
            return of_area_light(extent_over_time(l), light_power(l, 0), l.two_sided);
        }
        Bounds operator()(const MediumLight& l) const {
            return {l.grid->glow()->bounds(), {0, 0, 1}, -1, 0, light_power(l, 0), false};
        }
        Bounds operator()(const DistantLight&) const { return {}; }
        Bounds operator()(const UniformInfiniteLight&) const { return {}; }
        Bounds operator()(const SkyDiskLight&) const { return {}; }
        Bounds operator()(const ImageInfiniteLight&) const { return {}; }
        Bounds operator()(const PortalInfiniteLight&) const { return {}; }

        static Bounds of_area_light(const LightExtent& extent, float power, bool two_sided) {
            const Vec3 axis = extent.axis.value_or(Vec3(0, 0, 1));
            return {extent.box, axis, extent.axis ? 1.0f : -1.0f, 0, power, two_sided};
        }

        /// Of a point that shines up to an outer angle around its own z axis. Who stands within it sees no less than
        /// of one that shines everywhere.
        static Bounds in_cone(const Vec3& position, const AffineMap& light_from_world, float cos_inner, float cos_outer,
                              float intensity) {
            Bounds b{Box3(position), {0, 0, 1}, -1, 0, 4 * pi * intensity, false};
            const auto axis = axis_of(light_from_world);
            if (axis) {
                // Rounding must not leave the edge of the cone without light.
                constexpr float margin = 1e-3f;
                b.axis = *axis;
                b.cos_o = cos_inner;
                const float width =
                    std::acos(std::clamp(cos_outer, -1.0f, 1.0f)) - std::acos(std::clamp(cos_inner, -1.0f, 1.0f));
                b.cos_e = std::cos(std::min(width + margin, pi));
            }
            return b;
        }
    };
    return std::visit(Make{}, light);
}

TreeLightSampler::Bounds TreeLightSampler::merge(const Bounds& a, const Bounds& b) {
    if (!(a.power > 0)) {
        return b;
    }
    if (!(b.power > 0)) {
        return a;
    }
    Bounds m;
    m.box = a.box;
    m.box.extendBy(b.box);
    m.power = a.power + b.power;
    m.cos_e = std::min(a.cos_e, b.cos_e);
    m.two_sided = a.two_sided || b.two_sided;
    // The smallest cone around both cones of normals.
    const float angle_a = std::acos(std::clamp(a.cos_o, -1.0f, 1.0f));
    const float angle_b = std::acos(std::clamp(b.cos_o, -1.0f, 1.0f));
    const float between = std::acos(std::clamp(dot(a.axis, b.axis), -1.0f, 1.0f));
    if (std::min(between + angle_b, pi) <= angle_a) {
        m.axis = a.axis;
        m.cos_o = a.cos_o;
    } else if (std::min(between + angle_a, pi) <= angle_b) {
        m.axis = b.axis;
        m.cos_o = b.cos_o;
    } else {
        const float angle = 0.5f * (angle_a + between + angle_b);
        const Vec3 normal = cross(a.axis, b.axis);
        if (angle >= pi || length_squared(normal) == 0) {
            m.axis = a.axis;
            m.cos_o = -1;
        } else {
            const float turn = angle - angle_a;
            const Vec3 side = normalize(cross(normal, a.axis));
            m.axis = normalize(a.axis * std::cos(turn) + side * std::sin(turn));
            m.cos_o = std::cos(angle);
        }
    }
    return m;
}

TreeLightSampler::TreeLightSampler(std::span<const Light> lights, float scene_radius)
    : leaf_of_light_(lights.size(), -1) {
    std::vector<std::pair<int, Bounds>> placed;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (is_at_infinity(lights[i])) {
            // What shines on nothing is never chosen.
            if (light_power(lights[i], scene_radius) > 0) {
                infinite_.push_back(static_cast<int>(i));
            }
            continue;
        }
        const Bounds b = bounds_of(lights[i]);
        if (b.power > 0) {
            placed.emplace_back(static_cast<int>(i), b);
        }
    }
    if (!placed.empty()) {
        nodes_.reserve(2 * placed.size());
        build(placed, -1);
    }
}

int TreeLightSampler::build(std::span<std::pair<int, Bounds>> lights, int parent) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    nodes_.back().parent = parent;
    if (lights.size() == 1) {
        nodes_.back().bounds = lights[0].second;
        nodes_.back().light = lights[0].first;
        leaf_of_light_[static_cast<std::size_t>(lights[0].first)] = index;
        return index;
    }
    // Split where the sum of power times surface area times spread of normals is least, over buckets of the widest
    // axis.
    Box3 centres;
    for (const auto& [light, b] : lights) {
        centres.extendBy(b.box.center());
    }
    const int axis = static_cast<int>(centres.majorAxis());
    const float low = centres.min[axis];
    const float extent = centres.max[axis] - low;
    std::size_t middle = lights.size() / 2;
    const auto by_axis = [axis](const auto& a, const auto& b) {
        const float ca = a.second.box.center()[axis];
        const float cb = b.second.box.center()[axis];
        return ca != cb ? ca < cb : a.first < b.first;
    };
    std::sort(lights.begin(), lights.end(), by_axis);
    if (extent > 0) {
        const auto cost = [](const Bounds& b) {
            const Vec3 d = b.box.size();
            const float area = 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
            return b.power * (area + 1e-6f * length_squared(d)) * (2 - b.cos_o);
        };
        std::vector<Bounds> from_right(lights.size());
        from_right.back() = lights.back().second;
        for (std::size_t i = lights.size() - 1; i-- > 0;) {
            from_right[i] = merge(lights[i].second, from_right[i + 1]);
        }
        float best = infinity;
        Bounds left = lights[0].second;
        for (std::size_t i = 1; i < lights.size(); ++i) {
            const float c = cost(left) + cost(from_right[i]);
            if (c < best) {
                best = c;
                middle = i;
            }
            left = merge(left, lights[i].second);
        }
        // A tree much deeper than the logarithm of its size would cost more than it gains.
        const std::size_t least = std::max<std::size_t>(1, lights.size() / 16);
        middle = std::clamp(middle, least, lights.size() - least);
    }
    build(lights.first(middle), index);
    const int second = build(lights.subspan(middle), index);
    nodes_[static_cast<std::size_t>(index)].child = second;
    nodes_[static_cast<std::size_t>(index)].bounds =
        merge(nodes_[static_cast<std::size_t>(index) + 1].bounds, nodes_[static_cast<std::size_t>(second)].bounds);
    return index;
}

float TreeLightSampler::infinite_probability() const {
    const auto n = static_cast<float>(infinite_.size());
    return n / (n + (nodes_.empty() ? 0.0f : 1.0f));
}

ChosenLight TreeLightSampler::sample(const LightReceiver& receiver, float u) const {
    const float p_infinite = infinite_.empty() ? 0.0f : infinite_probability();
    if (u < p_infinite) {
        const auto n = static_cast<float>(infinite_.size());
        const auto i = std::min(static_cast<std::size_t>(u / p_infinite * n), infinite_.size() - 1);
        return {infinite_[i], p_infinite / n};
    }
    if (nodes_.empty()) {
        return {};
    }
    u = std::min((u - p_infinite) / (1 - p_infinite), one_minus_epsilon);
    float probability = 1 - p_infinite;
    std::size_t node = 0;
    while (nodes_[node].light < 0) {
        const std::size_t first = node + 1;
        const auto second = static_cast<std::size_t>(nodes_[node].child);
        const float a = nodes_[first].bounds.importance(receiver);
        const float b = nodes_[second].bounds.importance(receiver);
        if (!(a + b > 0)) {
            return {};
        }
        const float p = a / (a + b);
        if (u < p) {
            node = first;
            u = std::min(u / p, one_minus_epsilon);
            probability *= p;
        } else {
            node = second;
            u = std::min((u - p) / (1 - p), one_minus_epsilon);
            probability *= 1 - p;
        }
    }
    if (node == 0 && !(nodes_[0].bounds.importance(receiver) > 0)) {
        return {};
    }
    return {nodes_[node].light, probability};
}

float TreeLightSampler::probability(const LightReceiver& receiver, int light) const {
    const float p_infinite = infinite_.empty() ? 0.0f : infinite_probability();
    int node = leaf_of_light_[static_cast<std::size_t>(light)];
    if (node < 0) {
        return std::find(infinite_.begin(), infinite_.end(), light) != infinite_.end()
                   ? p_infinite / static_cast<float>(infinite_.size())
                   : 0.0f;
    }
    float probability = 1 - p_infinite;
    if (nodes_[static_cast<std::size_t>(node)].parent < 0) {
        return nodes_[0].bounds.importance(receiver) > 0 ? probability : 0.0f;
    }
    while (nodes_[static_cast<std::size_t>(node)].parent >= 0) {
        const int parent = nodes_[static_cast<std::size_t>(node)].parent;
        const float a = nodes_[static_cast<std::size_t>(parent) + 1].bounds.importance(receiver);
        const float b =
            nodes_[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(parent)].child)].bounds.importance(
                receiver);
        const bool is_first = node == parent + 1;
        probability *= a + b > 0 ? (is_first ? a : b) / (a + b) : 0.0f;
        node = parent;
    }
    return probability;
}

}  // namespace wend
