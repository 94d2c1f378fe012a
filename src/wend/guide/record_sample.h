// A few of a render's many records, to look at.
#pragma once

#include <wend/core/random.h>
#include <wend/guide/path_records.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace wend::guide {

/// A sample of all records added, each of them equally likely to be in it (Algorithm R of vitter1985). The same records
/// in the same order leave the same sample.
class RecordSample {
public:
    /// Keeps at most `most` records; at least 1.
    explicit RecordSample(std::size_t most = std::size_t{1} << 18) : most_(most) {}

    /// Adds the records that a field can learn from.
    void add(std::span<const Record> records);

    /// How many were added.
    std::uint64_t seen() const { return seen_; }
    const Records& records() const { return records_; }

private:
    friend RecordSample record_sample_from_bytes(std::string_view bytes);

    std::size_t most_;
    std::uint64_t seen_ = 0;
    Records records_;
    Pcg32 random_{0};
};

/// The sample as bytes, with a version and a checksum; numbers are in this machine's order.
std::string to_bytes(const RecordSample& sample);

/// The sample again, for reading only. Throws InputError for bytes of another kind or version, truncated ones, or ones
/// that were changed.
RecordSample record_sample_from_bytes(std::string_view bytes);

}  // namespace wend::guide
