#include <wend/openpgl/sample_store.h>

#include <tbb/parallel_sort.h>
#include <wend/core/archive.h>
#include <wend/core/random.h>
#include <wend/guide/sealed_bytes.h>
#include <wend/openpgl/values.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <thread>
#include <utility>

namespace wend::openpgl {
namespace {

constexpr guide::SealedKind kind_of_samples{"training samples", "samples", "WENDPGS\x1a", 1};

/// A sample of value zero without bytes that mean nothing.
struct PackedZero {
    pgl_point3f position;
    pgl_direction direction;
};

std::size_t index_of(Half half) {
    return half == Half::volume ? 1 : 0;
}
std::size_t half_of(const PGLSampleData& sample) {
    return index_of(sample.flags & PGLSampleData::EInsideVolume ? Half::volume : Half::surface);
}

/// What decides about the place of a value, and where it is now.
struct Key {
    std::uint64_t hash;
    std::size_t place;
};

/// Moves each value to where its key is. Afterwards the keys' places are in order.
template <class T>
void permute(std::vector<T>& values, std::vector<Key>& keys) {
    for (std::size_t first = 0; first < keys.size(); ++first) {
        const T moved = values[first];
        std::size_t i = first;
        while (keys[i].place != first) {
            const std::size_t next = std::exchange(keys[i].place, i);
            values[i] = values[next];
            i = next;
        }
        values[i] = moved;
        keys[i].place = i;
    }
}

/// Sorts values, which are words of four bytes without gaps, by a hash of them; equal hashes by the words themselves.
/// In place but for the keys, since there may be many.
template <class T>
void sort_by_content(std::vector<T>& values) {
    constexpr std::size_t words = sizeof(T) / sizeof(std::uint32_t);
    static_assert(PlainValue<T> && sizeof(T) % sizeof(std::uint32_t) == 0);
    std::vector<Key> keys(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::array<std::uint32_t, words> bits;
        std::memcpy(bits.data(), static_cast<const void*>(&values[i]), sizeof bits);
        std::uint64_t hash = 0;
        for (const std::uint32_t word : bits) {
            hash = hash_of(hash, word);
        }
        keys[i] = {hash, i};
    }
    const auto bytes = [&](const Key& key) { return static_cast<const void*>(&values[key.place]); };
    tbb::parallel_sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
        return a.hash != b.hash ? a.hash < b.hash : std::memcmp(bytes(a), bytes(b), sizeof(T)) < 0;
    });
    permute(values, keys);
}

}  // namespace

guide::Record record_of(const Sample& sample) {
    const PGLSampleData& s = sample.data;
    guide::Record record{to_vector(s.position), to_vector(s.direction), s.weight * s.pdf, s.pdf,
                         s.distance > 0 ? s.distance : std::numeric_limits<float>::infinity()};
    record.colour = sample.colour;
    return record;
}

guide::Record record_of(const PGLZeroValueSampleData& sample) {
    // Neither the density nor the distance of what is dark teaches anything.
    return {to_vector(sample.position), to_vector(sample.direction), 0, inv_4pi,
            std::numeric_limits<float>::infinity()};
}

SampleStore::Shard& SampleStore::own_shard() {
    const std::uint64_t thread = std::hash<std::thread::id>()(std::this_thread::get_id());
    return (*shards_)[hash_of(thread) % shard_count];
}

void SampleStore::add(std::span<const Sample> samples) {
    Shard& shard = own_shard();
    const std::lock_guard lock(shard.mutex);
    for (const Sample& sample : samples) {
        shard.halves[half_of(sample.data)].lit.push_back(sample);
    }
}

void SampleStore::add(std::span<const PGLSampleData> samples) {
    Shard& shard = own_shard();
    const std::lock_guard lock(shard.mutex);
    for (const PGLSampleData& sample : samples) {
        shard.halves[half_of(sample)].lit.push_back({sample, Rgb()});
    }
}

void SampleStore::add(std::span<const PGLZeroValueSampleData> samples) {
    Shard& shard = own_shard();
    const std::lock_guard lock(shard.mutex);
    for (const PGLZeroValueSampleData& sample : samples) {
        shard.halves[index_of(sample.volume ? Half::volume : Half::surface)].zero.push_back(sample);
    }
}

void SampleStore::add(const SampleStore& other) {
    for (const Half half : {Half::surface, Half::volume}) {
        const Samples samples = other.all(half);
        add(samples.lit);
        add(samples.zero);
    }
}

void SampleStore::clear(Half half) {
    for (Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        shard.halves[index_of(half)].lit.clear();
        shard.halves[index_of(half)].zero.clear();
    }
}

SampleStore::Samples SampleStore::all(Half half) const {
    Samples all;
    for (const Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        const Samples& part = shard.halves[index_of(half)];
        all.lit.insert(all.lit.end(), part.lit.begin(), part.lit.end());
        all.zero.insert(all.zero.end(), part.zero.begin(), part.zero.end());
    }
    return all;
}

std::size_t SampleStore::size(Half half) const {
    std::size_t size = 0;
    for (const Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        size += shard.halves[index_of(half)].lit.size();
    }
    return size;
}

std::size_t SampleStore::zeros(Half half) const {
    std::size_t size = 0;
    for (const Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        size += shard.halves[index_of(half)].zero.size();
    }
    return size;
}

PGLSampleData SampleStore::sample(Half half, std::size_t i) const {
    for (const Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        const std::vector<Sample>& part = shard.halves[index_of(half)].lit;
        if (i < part.size()) {
            return part[i].data;
        }
        i -= part.size();
    }
    return {};
}

PGLZeroValueSampleData SampleStore::zero(Half half, std::size_t i) const {
    for (const Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        const std::vector<PGLZeroValueSampleData>& part = shard.halves[index_of(half)].zero;
        if (i < part.size()) {
            return part[i];
        }
        i -= part.size();
    }
    return {};
}

guide::Records SampleStore::records(Half half) const {
    guide::Records records;
    records.reserve(size(half) + zeros(half));
    for (const Shard& shard : *shards_) {
        const std::lock_guard lock(shard.mutex);
        for (const Sample& sample : shard.halves[index_of(half)].lit) {
            records.push_back(record_of(sample));
        }
        for (const PGLZeroValueSampleData& sample : shard.halves[index_of(half)].zero) {
            records.push_back(record_of(sample));
        }
    }
    sort_by_content(records);
    return records;
}

std::string SampleStore::to_bytes() const {
    ArchiveWriter bytes;
    for (const Half half : {Half::surface, Half::volume}) {
        Samples samples = all(half);
        std::vector<PackedZero> zeros;
        zeros.reserve(samples.zero.size());
        for (const PGLZeroValueSampleData& sample : samples.zero) {
            zeros.push_back({sample.position, sample.direction});
        }
        sort_by_content(samples.lit);
        sort_by_content(zeros);
        bytes(samples.lit, zeros);
    }
    return guide::seal(kind_of_samples, bytes.bytes());
}

SampleStore SampleStore::from_bytes(std::string_view bytes) {
    ArchiveReader body(guide::unseal(kind_of_samples, bytes));
    SampleStore store;
    for (const Half half : {Half::surface, Half::volume}) {
        std::vector<Sample> samples;
        std::vector<PackedZero> packed;
        body(samples, packed);
        for (const Sample& sample : samples) {
            ArchiveReader::require(half_of(sample.data) == index_of(half));
        }
        store.add(samples);
        std::vector<PGLZeroValueSampleData> zeros;
        zeros.reserve(packed.size());
        for (const PackedZero& zero : packed) {
            zeros.push_back({zero.position, zero.direction, half == Half::volume});
        }
        store.add(zeros);
    }
    ArchiveReader::require(body.empty());
    return store;
}

}  // namespace wend::openpgl
