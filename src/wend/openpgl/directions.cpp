#include <wend/openpgl/directions.h>

#include <wend/medium/phase.h>

#include <algorithm>
#include <cmath>

namespace wend::openpgl {
namespace {

/// In [0,1).
float to_unit(float u) {
    return u > 0 ? std::min(u, one_minus_epsilon) : 0.0f;
}

std::optional<Vec3> to_unit_length(const Vec3& v) {
    const float size = length(v);
    return size > 0 && std::isfinite(size) ? std::optional(v / size) : std::nullopt;
}

}  // namespace

bool Directions::init(const guide::Field* field, const Vec3& position) {
    const guide::Region* region = field && is_finite(position) ? field->find(position) : nullptr;
    if (!region) {
        clear();
        return false;
    }
    position_ = position;
    incident_ = region->incident(position);
    fluence_ = region->fluence();
    colours_ = region->colours();
    product_.reset();
    cell_ = static_cast<std::uint32_t>(field->index_of(*region));
    return initialized_ = true;
}

void Directions::clear() {
    *this = Directions();
}

void Directions::multiply(const AxialLobes& lobes) {
    product_.emplace(incident_, lobes);
}

Vec3 Directions::sample(const Vec2& u) const {
    const Vec2 point(to_unit(u.x), to_unit(u.y));
    return product_ ? product_->sample(point) : incident_.sample(point);
}

float Directions::density(const Vec3& direction) const {
    return product_ ? product_->density(direction) : incident_.density(direction);
}

std::optional<AxialLobes> cosine_lobes(const Vec3& normal) {
    const auto axis = to_unit_length(normal);
    return axis ? std::optional(AxialLobes::cosine().around(*axis)) : std::nullopt;
}

std::optional<AxialLobes> PhaseLobes::around(const Vec3& before, float mean_cosine) {
    constexpr float most = 0.999f;
    const auto axis = to_unit_length(before);
    if (!axis || std::isnan(mean_cosine)) {
        return std::nullopt;
    }
    if (mean_cosine != mean_cosine_) {
        lobes_ = HenyeyGreenstein{std::clamp(mean_cosine, -most, most)}.lobes();
        mean_cosine_ = mean_cosine;
    }
    return lobes_.around(*axis);
}

}  // namespace wend::openpgl
