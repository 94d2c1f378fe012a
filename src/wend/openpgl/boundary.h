// Between C and C++: the objects behind Open PGL's handles, and exceptions that must not go out.
#pragma once

#include <openpgl/openpgl.h>
#include <wend/openpgl/directions.h>
#include <wend/openpgl/learned_field.h>
#include <wend/openpgl/path_segments.h>
#include <wend/openpgl/sample_store.h>

#include <concepts>
#include <cstdint>
#include <utility>

namespace wend::openpgl {

/// How an object behind a handle begins, by which it is told from one of another kind.
template <std::uint64_t own_mark>
struct Marked {
    static constexpr std::uint64_t mark = own_mark;

    std::uint64_t found = mark;
};

}  // namespace wend::openpgl

struct PGLDeviceObject : wend::openpgl::Marked<0x57454e4450474c31> {
    explicit PGLDeviceObject(int count) : threads(count) {}
    int threads;
};
struct PGLFieldObject : wend::openpgl::Marked<0x57454e4450474c32> {
    explicit PGLFieldObject(wend::openpgl::LearnedField field) : value(std::move(field)) {}
    wend::openpgl::LearnedField value;
};
struct PGLFieldStatisticsObject : wend::openpgl::Marked<0x57454e4450474c33> {
    explicit PGLFieldStatisticsObject(const wend::openpgl::FieldStatistics& statistics) : value(statistics) {}
    wend::openpgl::FieldStatistics value;
};
struct PGLSampleStorageObject : wend::openpgl::Marked<0x57454e4450474c34> {
    PGLSampleStorageObject() = default;
    explicit PGLSampleStorageObject(wend::openpgl::SampleStore samples) : value(std::move(samples)) {}
    wend::openpgl::SampleStore value;
};
struct PGLPathSegmentStorageObject : wend::openpgl::Marked<0x57454e4450474c35> {
    wend::openpgl::PathSegments value;
};
struct PGLSurfaceSamplingDistributionObject : wend::openpgl::Marked<0x57454e4450474c36> {
    wend::openpgl::Directions value;
};
struct PGLVolumeSamplingDistributionObject : wend::openpgl::Marked<0x57454e4450474c37> {
    wend::openpgl::Directions value;
    wend::openpgl::PhaseLobes phase;
};

namespace wend::openpgl {

/// Whether a handle is one of its kind: neither null nor of another.
template <class Object>
bool is_object(const Object* handle) {
    return handle && handle->found == Object::mark;
}
/// Ends an object, if it is one.
template <class Object>
void release(Object* handle) {
    if (is_object(handle)) {
        delete handle;
    }
}

/// Says on the standard error stream what the exception at hand is about: the interface has no other way.
void report_exception() noexcept;

/// What the body returns, or the other value if it throws.
template <class Result, std::invocable Body>
Result guarded(Result otherwise, const Body& body) noexcept {
    try {
        return body();
    } catch (...) {
        report_exception();
        return otherwise;
    }
}
template <std::invocable Body>
void guarded(const Body& body) noexcept {
    try {
        body();
    } catch (...) {
        report_exception();
    }
}

}  // namespace wend::openpgl
