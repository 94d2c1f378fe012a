#pragma once

#include <wend/film/metrics.h>

#include <filesystem>
#include <optional>

namespace wend {

/// The files of a reference's two halves: NAME.ref-a.exr and NAME.ref-b.exr.
struct ReferenceFiles {
    std::filesystem::path a, b;
};
ReferenceFiles reference_files(const std::filesystem::path& name);

/// Reads the pair of a reference; nothing where one of the files is absent. Throws InputError for broken ones.
std::optional<Reference> read_reference_pair(const std::filesystem::path& name);

/// Reads a reference: a pair, or one picture file that stands for both halves. Throws InputError if neither is there.
Reference read_reference(const std::filesystem::path& name);

}  // namespace wend
