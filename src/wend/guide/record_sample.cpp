#include <wend/guide/record_sample.h>

#include <wend/core/error.h>
#include <wend/guide/sealed_bytes.h>

#include <array>
#include <cstring>

namespace wend::guide {
namespace {

constexpr SealedKind sealed_records{"guiding records", "records", "WENDREC\x1a", 1};

/// The numbers of a record, in the order of the version.
using Numbers = std::array<float, 15>;

Numbers pack(const Record& r) {
    return {r.position.x,     r.position.y, r.position.z, r.direction.x, r.direction.y,
            r.direction.z,    r.radiance,   r.density,    r.distance,    r.classical_density,
            r.guided_density, r.scattered,  r.colour.r,   r.colour.g,    r.colour.b};
}

Record unpack(const Numbers& n) {
    return {Vec3(n[0], n[1], n[2]),  Vec3(n[3], n[4], n[5]), n[6], n[7], n[8], n[9], n[10], n[11],
            Rgb(n[12], n[13], n[14])};
}

}  // namespace

void RecordSample::add(std::span<const Record> records) {
    for (const Record& record : records) {
        if (!is_usable(record)) {
            continue;
        }
        ++seen_;
        if (records_.size() < most_) {
            records_.push_back(record);
            continue;
        }
        const auto place = static_cast<std::uint64_t>(random_.uniform_double() * static_cast<double>(seen_));
        if (place < most_) {
            records_[place] = record;
        }
    }
}

std::string to_bytes(const RecordSample& sample) {
    const std::uint64_t seen = sample.seen();
    std::string body(reinterpret_cast<const char*>(&seen), sizeof seen);
    for (const Record& record : sample.records()) {
        const Numbers numbers = pack(record);
        body.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    }
    return seal(sealed_records, body);
}

RecordSample record_sample_from_bytes(std::string_view bytes) {
    const std::string_view body = unseal(sealed_records, bytes);
    const auto require = [](bool holds) {
        if (!holds) {
            throw InputError(std::string(sealed_records.title) + ": a number is out of range");
        }
    };
    RecordSample sample;
    constexpr std::size_t head = sizeof sample.seen_;
    require(body.size() >= head && (body.size() - head) % sizeof(Numbers) == 0);
    std::memcpy(&sample.seen_, body.data(), head);
    for (std::size_t at = head; at < body.size(); at += sizeof(Numbers)) {
        Numbers numbers;
        std::memcpy(numbers.data(), body.data() + at, sizeof numbers);
        sample.records_.push_back(unpack(numbers));
        require(is_usable(sample.records_.back()));
    }
    require(sample.seen_ >= sample.records_.size());
    return sample;
}

}  // namespace wend::guide
