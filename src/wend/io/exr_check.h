// What has to be known of an OpenEXR file before its library may read it.
#pragma once

#include <wend/core/error.h>

#include <OpenEXR/ImfIO.h>

#include <filesystem>

namespace wend {

/// The library takes memory for what an attribute says that it holds: this compares that with the file's size. Throws
/// InputError at the place.
void check_exr_attributes(const std::filesystem::path& file, const Place& place);

/// Looks at the header alone, and goes back to the stream's start: opening the file for reading already takes memory in
/// proportion to its declared size. Throws InputError at the place, and what the library throws.
void check_exr_size(Imf::IStream& stream, const Place& place);

}  // namespace wend
