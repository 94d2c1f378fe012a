// A field as bytes, to keep it or to send it.
#pragma once

#include <wend/core/export.h>
#include <wend/guide/field.h>

#include <string>
#include <string_view>

namespace wend::guide {

/// All that a field knows, so that field_from_bytes() gives one that answers the same, bit for bit, and learns on the
/// same. The bytes begin with a signature and a version and end with a checksum; numbers are in this machine's order.
WEND_API std::string to_bytes(const Field& field);

/// The field again. Throws InputError for bytes of another kind or version, truncated ones, or ones that were changed.
WEND_API Field field_from_bytes(std::string_view bytes);

}  // namespace wend::guide
