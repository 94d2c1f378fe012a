// What the parts of the module share.
#pragma once

#include <wend/core/image.h>
#include <wend/core/vector.h>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace wend::python {

namespace nb = nanobind;

/// Arrays that come from Python: as they lie in memory, which is checked and never copied.
using Floats = nb::ndarray<const float, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Pairs = nb::ndarray<const float, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Vectors = nb::ndarray<const float, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Pixels = nb::ndarray<const float, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;

/// Results by name, and rows of them.
using Values = nb::typed<nb::dict, nb::str, nb::any>;
using Rows = nb::typed<nb::list, Values>;

static_assert(sizeof(Vec3) == 3 * sizeof(float) && sizeof(Vec2) == 2 * sizeof(float));

/// For long work without the GIL to call now and then: Ctrl-C ends it, by an exception, in the thread that this one is.
inline auto let_signals_arrive() {
    return [caller = std::this_thread::get_id()] {
        if (std::this_thread::get_id() != caller) {
            return;
        }
        const nb::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) {
            throw nb::python_error();
        }
    };
}

inline const Vec3* vectors(const Vectors& array) {
    return reinterpret_cast<const Vec3*>(array.data());
}
inline const Vec2* pairs(const Pairs& array) {
    return reinterpret_cast<const Vec2*>(array.data());
}

/// Numbers that Python owns from here on, with the shape given.
template <class T>
auto to_array(std::vector<T> values, std::initializer_list<std::size_t> shape) {
    auto owner = std::make_unique<std::vector<T>>(std::move(values));
    T* data = owner->data();
    const nb::capsule release(owner.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return nb::ndarray<nb::numpy, T>(data, shape, release);
}

/// The same for vectors of so many floats each.
template <class Vector>
auto to_rows(std::vector<Vector> values) {
    auto owner = std::make_unique<std::vector<Vector>>(std::move(values));
    auto* data = reinterpret_cast<float*>(owner->data());
    const std::size_t count = owner->size();
    const nb::capsule release(owner.release(), [](void* p) noexcept { delete static_cast<std::vector<Vector>*>(p); });
    return nb::ndarray<nb::numpy, float>(data, {count, sizeof(Vector) / sizeof(float)}, release);
}

inline Image to_image(const Pixels& array) {
    Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    std::copy_n(array.data(), array.size(), &image.pixels.data()->r);
    return image;
}

void bind_pictures(nb::module_& module);
void bind_scenes(nb::module_& module);
void bind_directives(nb::module_& module);
void bind_renders(nb::module_& module);
void bind_comparisons(nb::module_& module);
void bind_fields(nb::module_& module);
void bind_laboratory(nb::module_& module);

}  // namespace wend::python
