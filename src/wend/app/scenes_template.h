// The text of the page over several scenes around its data.
#pragma once

#include <string_view>

namespace wend {

/// HTML for framed_page(): {{title}}, {{note}}, {{gains}}, {{plot}}, {{cases}}, {{failed}}, {{scenes}}, {{settings}}.
extern const std::string_view scenes_template;
extern const std::string_view scenes_style;

}  // namespace wend
