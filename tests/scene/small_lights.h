// Lamps of one radiance.
#pragma once

#include <wend/scene/light.h>

#include <memory>
#include <utility>
#include <variant>

namespace wend::test {

inline const Rgb radiance(2, 3, 5);

inline Light quadric_light(std::variant<Sphere, Disk> shape, const Transform& place, bool two_sided = false,
                           bool flip = false) {
    return make_quadric_light(std::make_shared<Quadric>(std::move(shape), place), place, flip, radiance, two_sided);
}

}  // namespace wend::test
