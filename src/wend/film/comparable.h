#pragma once

#include <wend/core/image.h>

#include <string>

namespace wend {

/// Throws InputError unless `image` has as many pixels as its size says, at least one, and all of them finite; the
/// message names the first pixel that is not. `name` is what the message calls the image.
void require_finite(const Image& image, const std::string& name);

/// Throws InputError giving both sizes unless `image` and `reference` have the same size.
void require_same_size(const Image& image, const Image& reference, const std::string& reference_name);

}  // namespace wend
