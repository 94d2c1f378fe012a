#include <wend/io/records_file.h>

#include <wend/io/parts_file.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace wend {
namespace {

constexpr std::string_view records_signature = "WENDRECORDS\n";

}  // namespace

void RecordSamples::add(std::span<const guide::PathRecords> records) {
    for (const guide::PathRecords& part : records) {
        surface.add(part.surface());
        volume.add(part.volume());
    }
}

guide::Records records_in(const guide::RecordSample& sample, const guide::Field& field, const guide::Region* region) {
    guide::Records found;
    std::copy_if(sample.records().begin(), sample.records().end(), std::back_inserter(found),
                 [&](const guide::Record& r) { return field.find(r.position) == region; });
    return found;
}

void write_records(const std::filesystem::path& file, const RecordSamples& samples) {
    write_parts(file, records_signature, std::array{guide::to_bytes(samples.surface), guide::to_bytes(samples.volume)});
}

RecordSamples read_records(const std::filesystem::path& file) {
    const PartsFile parts(file, records_signature, 2, "records");
    return {parts.decode(0, guide::record_sample_from_bytes), parts.decode(1, guide::record_sample_from_bytes)};
}

}  // namespace wend
