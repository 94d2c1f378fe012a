#include <wend/io/mitsuba/transforms.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/object.h>

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace wend::mitsuba {
namespace {

Imath::V3d three_numbers(const Element& element, std::string_view attribute) {
    const std::vector<double> numbers = numbers_of(element.attribute(attribute), element.place);
    if (numbers.size() != 3) {
        throw InputError(element.place, fmt::format("\"{}\" of <{}> is three numbers, not {}", attribute, element.tag,
                                                    numbers.size()));
    }
    return {numbers[0], numbers[1], numbers[2]};
}

/// World from a space with its z axis towards the target and y axis up.
Transform look_at(const Element& step) {
    const Imath::V3d origin = three_numbers(step, "origin"), target = three_numbers(step, "target");
    Imath::V3d up = step.has("up") ? three_numbers(step, "up") : Imath::V3d(0.0);
    const Imath::V3d z = (target - origin).normalized();
    if (up.length() == 0) {
        up = std::abs(z.x) < 0.9 ? Imath::V3d(1, 0, 0) : Imath::V3d(0, 1, 0);
    }
    const Imath::V3d x = up.cross(z).normalized(), y = z.cross(x);
    const Transform::Matrix m = {
        {x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}, {0, 0, 0, 1}};
    return Transform(m);
}

/// Row by row: 16 numbers, or the 9 of the linear part.
Transform matrix(const Element& step) {
    const std::vector<double> numbers = numbers_of(step.attribute("value"), step.place);
    if (numbers.size() != 16 && numbers.size() != 9) {
        throw InputError(step.place, fmt::format("<matrix> is 16 or 9 numbers, not {}", numbers.size()));
    }
    const std::size_t side = numbers.size() == 16 ? 4 : 3;
    Transform::Matrix m = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        m[i / side][i % side] = numbers[i];
    }
    if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0 || m[3][3] != 1) {
        throw InputError(step.place, "the last row of a <matrix> is 0 0 0 1");
    }
    return Transform(m);
}

Transform transform_of_step(const Element& step) {
    if (step.tag == "lookat") {
        return look_at(step);
    }
    if (step.tag == "matrix") {
        return matrix(step);
    }
    const Imath::V3d v = vector_of(step, step.tag == "scale" ? 1 : 0);
    if (step.tag == "translate") {
        return Transform::translate(v.x, v.y, v.z);
    }
    if (step.tag == "scale") {
        return Transform::scale(v.x, v.y, v.z);
    }
    const std::vector<double> angle = numbers_of(step.attribute("angle"), step.place);
    if (angle.size() != 1 || v.length() == 0) {
        throw InputError(step.place, "<rotate> needs an axis that is not 0, and one angle in degrees");
    }
    return Transform::rotate(angle.front(), v.x, v.y, v.z);
}

}  // namespace

Imath::V3d vector_of(const Element& element, double missing) {
    if (element.has("value")) {
        const std::vector<double> numbers = numbers_of(element.attribute("value"), element.place);
        if (numbers.size() == 1) {
            return Imath::V3d(numbers.front());
        }
        return three_numbers(element, "value");
    }
    Imath::V3d vector(missing);
    for (int axis = 0; axis < 3; ++axis) {
        constexpr std::string_view names[] = {"x", "y", "z"};
        if (element.has(names[axis])) {
            const std::vector<double> numbers = numbers_of(element.attribute(names[axis]), element.place);
            if (numbers.size() != 1) {
                throw InputError(element.place, fmt::format("\"{}\" of <{}> is one number", names[axis], element.tag));
            }
            vector[axis] = numbers.front();
        }
    }
    return vector;
}

Transform transform_of(const Element& element) {
    Transform transform;
    for (const std::unique_ptr<Element>& step : element.children) {
        try {
            transform = transform_of_step(*step) * transform;
        } catch (const std::domain_error& error) {
            throw InputError(step->place, error.what());
        }
    }
    return transform;
}

}  // namespace wend::mitsuba
