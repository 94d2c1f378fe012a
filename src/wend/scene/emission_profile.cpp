#include <wend/scene/emission_profile.h>

#include <wend/scene/directional_light.h>

#include <algorithm>
#include <cmath>

namespace wend {

float EmissionProfile::towards(const Vec3& normal, const Vec3& w) const {
    if (kind == Kind::cone) {
        return cone_falloff(dot(axis, w), cos_inner, cos_outer, is_linear);
    }
    const float cosine = std::min(abs_dot(normal, w), 1.0f);
    if (!(cosine > std::cos(half_angle))) {
        return 0;
    }
    // For narrow beams, differences of tangents and angles leave single precision.
    const double tangent = std::tan(double{half_angle});
    const double here = std::sqrt(1 - double{cosine} * double{cosine}) / double{cosine};
    return static_cast<float>(std::max(tangent - here, 0.0) / (tangent - double{half_angle}));
}

float EmissionProfile::mean() const {
    // A part of all directions, as from a sphere; of a flat surface it is more.
    return kind == Kind::cone ? std::max(0.25f * (2 - cos_inner - cos_outer), 1e-6f) : 1.0f;
}

}  // namespace wend
