// The training loop's state: the learned fields of surfaces and volumes.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/path_records.h>

#include <vector>

namespace wend::guide {

/// The two learned fields.
struct Fields {
    Field surface;
    Field volume;

    std::size_t bytes() const { return surface.bytes() + volume.bytes(); }
};

/// The next fields, learned from the records of all producers in the order given.
Fields learn(const Fields& fields, std::vector<PathRecords> records, int threads);

}  // namespace wend::guide
