#pragma once

#include <wend/film/metrics.h>

#include <filesystem>
#include <optional>
#include <string>

namespace wend {

/// The files of a reference's two halves: NAME.ref-a.exr and NAME.ref-b.exr.
struct ReferenceFiles {
    std::filesystem::path a, b;
};
ReferenceFiles reference_files(const std::filesystem::path& name);

/// Reads the pair of a reference; nothing where one of the files is absent. Throws InputError for broken ones.
std::optional<Reference> read_reference_pair(const std::filesystem::path& name);

/// What a pair lacks, in words, where it is not whole: "no room.ref-a.exr", or "room.ref-a.exr without room.ref-b.exr"
/// where one half is alone.
std::string what_is_missing(const std::filesystem::path& name);

/// Reads a reference: a pair, or one picture file that stands for both halves. Throws InputError if neither is there.
Reference read_reference(const std::filesystem::path& name);

}  // namespace wend
