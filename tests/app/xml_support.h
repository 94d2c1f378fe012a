// Whether text is well-formed markup, as far as the program's own pictures need to know.
#pragma once

#include <string>
#include <string_view>

namespace wend::test {

/// What is wrong with a document of nested elements (tags that do not match, attributes without quotes, a stray '<' or
/// '&', more than one root); empty: nothing. Knows no comments, declarations or character data sections.
std::string xml_problem(std::string_view text);

}  // namespace wend::test
