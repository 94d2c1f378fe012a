// Between C and C++: the objects behind Open PGL's handles, and exceptions that must not go out.
#pragma once

#include <openpgl/openpgl.h>
#include <wend/openpgl/directions.h>
#include <wend/openpgl/learned_field.h>
#include <wend/openpgl/path_segments.h>
#include <wend/openpgl/sample_store.h>

#include <concepts>

struct PGLDeviceObject {
    int threads;
};
struct PGLFieldObject {
    wend::openpgl::LearnedField value;
};
struct PGLFieldStatisticsObject {
    wend::openpgl::FieldStatistics value;
};
struct PGLSampleStorageObject {
    wend::openpgl::SampleStore value;
};
struct PGLPathSegmentStorageObject {
    wend::openpgl::PathSegments value;
};
struct PGLSurfaceSamplingDistributionObject {
    wend::openpgl::Directions value;
};
struct PGLVolumeSamplingDistributionObject {
    wend::openpgl::Directions value;
    wend::openpgl::PhaseLobes phase;
};

namespace wend::openpgl {

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
