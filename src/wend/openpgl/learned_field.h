// Open PGL's field: one object for surfaces and volumes, which learns in place and may find out by itself how large the
// scene is.
#pragma once

#include <openpgl/config.h>
#include <wend/core/vector.h>
#include <wend/guide/fit.h>
#include <wend/openpgl/sample_store.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace wend::openpgl {

/// What Open PGL's arguments mean for a fit. Its samples per leaf are of another scale: its default stands for Wend's
/// own, and other numbers are in proportion.
guide::FitSettings settings_of(const PGLFieldArguments& arguments);

class LearnedField {
public:
    /// Fits on at most `threads` threads (0: all).
    LearnedField(const guide::FitSettings& settings, int threads) : settings_(settings), threads_(threads) {}

    /// To be learned in, from the next beginning on; a box that is empty or not finite is not taken.
    void set_bounds(const Box3& bounds);
    /// Those that were set, or else those that were found; empty as long as there are none.
    Box3 bounds() const;

    /// Learns from the halves of a store that are named.
    void update(const SampleStore& store, bool surface, bool volume);
    std::size_t iteration() const { return iteration_; }
    /// Forgets all but settings and the bounds that were set.
    void reset();

    /// Null as long as there are no bounds.
    const guide::Field* field(Half half) const;
    /// Of the last fit.
    const guide::FitReport& report(Half half) const { return half == Half::volume ? volume_ : surface_; }

    /// Whether both know the same.
    bool operator==(const LearnedField& other) const;

    /// All that it knows, to go on with.
    std::string to_bytes() const;
    /// Throws InputError for bytes of another kind or version, truncated ones, or ones that were changed.
    static LearnedField from_bytes(std::string_view bytes, int threads);

private:
    guide::FitSettings settings_;
    int threads_;
    std::optional<Box3> given_;
    std::optional<guide::Fields> fields_;
    guide::FitReport surface_, volume_;
    std::size_t iteration_ = 0;
};

/// A field's half in figures.
struct FieldStatistics {
    std::size_t iteration = 0;
    std::size_t cells = 0;
    std::size_t lobes = 0;
    std::size_t bytes = 0;
    /// That taught it, older ones counting less.
    double records = 0;
    /// The last fit.
    guide::FitReport report;
};
FieldStatistics statistics_of(const LearnedField& field, Half half);

/// A line for each figure.
std::string to_text(const FieldStatistics& statistics);
/// The figures' names, separated by commas.
std::string csv_header();
/// The figures in the same order.
std::string to_csv(const FieldStatistics& statistics);

}  // namespace wend::openpgl
