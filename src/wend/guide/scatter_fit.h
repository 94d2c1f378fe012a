// Training of what the field tells rays on their way: light scattered in its cells.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/path_records.h>

#include <span>

namespace wend::guide {

/// The field with the scattered light of its cells learned from the records, on top of what it knew, which counts
/// `decay` times as much as before. The cells stay as fit() made them. Records that are not usable teach nothing. The
/// result depends on the order of the records but not on the threads (0: all), bit for bit. Throws InputError for a
/// decay outside [0, 1].
Field fit_scattered(Field field, std::span<const ScatterRecord> records, double decay, int threads = 0);

}  // namespace wend::guide
