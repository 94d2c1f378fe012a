// Training: a new field from the previous one and the records of a pass.
#pragma once

#include <wend/core/export.h>
#include <wend/guide/field.h>
#include <wend/guide/path_records.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace wend::guide {

/// Beliefs before any record, in numbers of records.
struct LobePriors {
    /// Records that each lobe is believed to have.
    double weight = 0.01;
    /// Records with mean cosine 0 that each lobe is believed to have.
    double mean_cosine = 0.003;
    /// Concentrations stay below.
    float max_kappa = 2e4f;
};

/// How a field is fitted. fit() refuses what is out of range.
struct FitSettings {
    /// Lobes that a cell begins with, 1 to max_lobes.
    int lobes = 8;
    /// Lobes that a cell may have where its records call for them, `lobes` to max_lobes; where they do not, lobes are
    /// merged.
    int most_lobes = max_lobes;
    /// A cell holding more records than this is split where its halves differ; older records count less (see `decay`).
    double leaf_samples = 1000;
    /// A cell whose halves do not differ may hold this many times more, at least 1; and three times that where few of
    /// its records carry radiance, since what is rare cannot be learned in small cells.
    double uniform_factor = 8;
    /// Few are those that are worth less than this many records of equal weight; not negative.
    double uniform_evidence = 60;
    /// Halves differ when what is seen varies by more than this divergence in nats within the cell, and that is no
    /// chance; not negative.
    double variation = 0.002;
    /// Most splits above a cell, at most 64.
    int max_depth = 32;
    /// The field's memory, Field::bytes(), stays below; at least 64 KiB. The most used cells are split first.
    std::size_t max_bytes = std::size_t{256} << 20;
    /// How much the records of earlier fits count in this one, 0 (not at all) to 1.
    double decay = 0.8;
    /// Most rounds of expectation maximization, at least 1.
    int max_iterations = 12;
    /// Rounds end when the resultant vectors of the lobes move less than this share of the total weight.
    double tolerance = 5e-3;
    /// What lobes are drawn to as long as there are few records.
    LobePriors priors;
};

/// What a fit did.
struct FitReport {
    /// All that were given.
    std::size_t records = 0;
    /// Records with a number that is not finite or out of range (is_usable), which taught nothing.
    std::size_t ignored = 0;
    /// Usable records with zero radiance.
    std::size_t dark = 0;
    /// Field::size() of the new field.
    std::size_t cells = 0;
    /// Field::bytes() of the new field.
    std::size_t bytes = 0;
    /// Whether cells stayed unsplit for lack of memory.
    bool memory_limited = false;
};

/// What fit() makes.
struct FitResult {
    Field field;       ///< the next one
    FitReport report;  ///< for whoever wants to know how it went
};

/// Refines the previous field by the records, on at most `threads` threads (0: all). The result depends on the order of
/// the records but not on the threads, bit for bit. Cost is proportional to the number of records times the depth of
/// the tree. Throws InputError for settings out of range.
WEND_API FitResult fit(const Field& previous, std::span<const Record> records, const FitSettings& settings,
                       int threads = 0);

/// The two learned fields: surfaces and volumes in the same place see different light.
struct Fields {
    Field surface;  ///< asked at surfaces
    Field volume;   ///< asked at collisions in media
    /// What whoever walks by them knows besides, as bytes of its own; empty: nothing. Fitting does not keep them.
    std::string notes = {};

    /// Memory of both.
    std::size_t bytes() const { return surface.bytes() + volume.bytes(); }
};

/// The next fields, learned from the records of all producers in the order given.
WEND_API Fields learn(const Fields& fields, std::vector<PathRecords> records, int threads);

}  // namespace wend::guide
