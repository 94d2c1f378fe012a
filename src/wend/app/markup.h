// Text for HTML and SVG.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace wend {

/// The text with & < > " ' replaced, safe as element content and inside quoted attributes.
std::string escape_markup(std::string_view text);

/// Base64 of the bytes (RFC 4648, with padding).
std::string encode_base64(std::string_view bytes);

/// The template with every {{name}} replaced by its value; values are inserted as they are and not searched again.
/// Throws std::out_of_range for a name without a value.
std::string fill_template(std::string_view text, const std::map<std::string, std::string, std::less<>>& values);

}  // namespace wend
