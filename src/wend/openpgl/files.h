// Whole files as bytes.
#pragma once

#include <string>

namespace wend::openpgl {

/// Throws InputError where there is none that can be read.
std::string read_file(const char* name);
/// Writes the file beside and puts it into its place, so that there is never half of one. Throws InputError where that
/// is not possible.
void write_file(const char* name, const std::string& bytes);

}  // namespace wend::openpgl
