// Samples that threads collect together, and the records that a field learns from: in an order that no thread decides.
#pragma once

#include <openpgl/data.h>
#include <wend/core/colour.h>
#include <wend/guide/path_records.h>

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wend::openpgl {

/// A sample, and the colour of its radiance where that is known; black otherwise.
struct Sample {
    PGLSampleData data{};
    Rgb colour;
};

/// The record that a sample stands for: its radiance is its weight times its density. A distance that is not positive
/// is not known, as if infinite.
guide::Record record_of(const Sample& sample);

/// One of value zero.
guide::Record record_of(const PGLZeroValueSampleData& sample);

/// Which of a store's samples are meant, those of surfaces or of volumes.
enum class Half { surface, volume };

/// Any number of threads may add and ask at once.
class SampleStore {
public:
    SampleStore() : shards_(std::make_unique<std::array<Shard, shard_count>>()) {}

    /// Each goes to its half: that of volumes where flags say so.
    void add(std::span<const Sample> samples);
    void add(std::span<const PGLSampleData> samples);
    void add(std::span<const PGLZeroValueSampleData> samples);
    /// Adds what the other has; it may be the same.
    void add(const SampleStore& other);

    void clear(Half half);

    std::size_t size(Half half) const;
    std::size_t zeros(Half half) const;
    /// The i-th, of no order that means anything; one of zeros beyond the last.
    PGLSampleData sample(Half half, std::size_t i) const;
    PGLZeroValueSampleData zero(Half half, std::size_t i) const;

    /// All of them, those of value zero included, in an order that depends on what they say alone: of a hash of their
    /// bytes, so that no first ones are more alike than others.
    guide::Records records(Half half) const;

    /// As bytes, which do not depend on the order of adding either.
    std::string to_bytes() const;
    /// Throws InputError for bytes of another kind or version, truncated ones, or ones that were changed.
    static SampleStore from_bytes(std::string_view bytes);

private:
    struct Samples {
        std::vector<Sample> lit;
        std::vector<PGLZeroValueSampleData> zero;
    };
    /// What threads of one hash have added; few of them meet at its lock. A line of the cache of its own.
    struct alignas(64) Shard {
        mutable std::mutex mutex;
        std::array<Samples, 2> halves;
    };
    static constexpr std::size_t shard_count = 64;

    Shard& own_shard();
    /// All samples of a half.
    Samples all(Half half) const;

    std::unique_ptr<std::array<Shard, shard_count>> shards_;
};

}  // namespace wend::openpgl
