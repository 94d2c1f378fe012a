// Training by several processes: each fits a share of the cells, and all learn the same.
#pragma once

#include <wend/core/team.h>
#include <wend/guide/fit.h>

#include <cstdint>
#include <span>
#include <vector>

namespace wend::guide {

/// fit() where it is known which of the previous field's cells each record is in (FieldBytes::cell_at).
FitResult fit(const Field& previous, std::span<const Record> records, std::span<const std::uint32_t> cells,
              const FitSettings& settings, int threads);

/// learn() by other settings.
Fields learn(const Fields& fields, std::vector<PathRecords> records, const FitSettings& settings, int threads);

/// learn() where each record is with one of several processes: `records` has as many producers in all of them, and each
/// producer's records are with one, empty with the others. Records go to who fits their cell, what was fitted goes to
/// all. The same fields in all of them, bit for bit those of one process alone. Throws like Team.
Fields learn_together(const Fields& fields, std::vector<PathRecords> records, int threads, Team& team,
                      const FitSettings& settings = {});

}  // namespace wend::guide
