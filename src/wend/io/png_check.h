#pragma once

#include <wend/core/error.h>

#include <string>

namespace wend {

/// Makes a PNG file fit for stb, and leaves others as they are. Chunks of pixels that hold no byte are taken out: stb
/// copies them to nowhere. Throws InputError if the header is wrong, and if the pixels unpack to more than it says: stb
/// would take memory for all of that.
void prepare_png(std::string& file, const Place& place);

}  // namespace wend
