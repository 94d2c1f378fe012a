// Files of records: some of what a render learned from, to look at.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/path_records.h>
#include <wend/guide/record_sample.h>

#include <filesystem>
#include <span>

namespace wend {

/// Samples of the records of surfaces and of volumes.
struct RecordSamples {
    guide::RecordSample surface, volume;

    /// Adds the records of all producers, in the order given.
    void add(std::span<const guide::PathRecords> records);
};

/// The records of a sample that lie in a region of the field.
guide::Records records_in(const guide::RecordSample& sample, const guide::Field& field, const guide::Region* region);

/// Writes both samples. The file appears whole or not at all.
void write_records(const std::filesystem::path& file, const RecordSamples& samples);

/// Reads them again. Throws InputError naming the file when it is missing, of another kind or version, truncated or
/// changed.
RecordSamples read_records(const std::filesystem::path& file);

}  // namespace wend
