// The training loop's state: the learned fields of surfaces and volumes, and how walks become records.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/records.h>
#include <wend/integrator/path_tracer.h>

#include <span>

namespace wend {

/// The two learned fields.
struct GuidingFields {
    guide::Field surface;
    guide::Field volume;

    std::size_t bytes() const { return surface.bytes() + volume.bytes(); }
};

/// Records of one producer, kept apart by field.
struct TrainingRecords {
    guide::Records surface;
    guide::Records volume;

    /// Turns the vertices of a finished walk into records, given the radiance it gathered in all. Costs O(vertices).
    /// Of very long walks only every 2^k-th vertex is kept.
    void add_walk(std::span<const WalkVertex> vertices, const Rgb& gathered);
};

/// The next fields, learned from the records of all producers in the order given.
GuidingFields learn(const GuidingFields& fields, std::span<const TrainingRecords> records, int threads);

}  // namespace wend
