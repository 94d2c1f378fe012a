#pragma once

#include <string_view>

namespace wend {

/// Whether no Huffman table of a JPEG file declares more symbols than there are (256): stb writes beyond its tables
/// when one does. True for what is not a JPEG file.
bool huffman_tables_fit(std::string_view file);

}  // namespace wend
