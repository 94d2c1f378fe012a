#pragma once

#include <wend/film/metrics.h>

#include <filesystem>

namespace wend {

/// Reads a reference: the pair NAME.ref-a.exr and NAME.ref-b.exr, or one picture file that stands for both halves.
/// Throws InputError if neither is there.
Reference read_reference(const std::filesystem::path& name);

}  // namespace wend
