// The text of the page of lobes around its data.
#pragma once

#include <string_view>

namespace wend {

/// HTML for framed_page(): {{title}}, {{file}}, {{options}}, {{low}}, {{high}}, {{flight}}, {{places}}, {{data}},
/// {{script}}.
extern const std::string_view lobe_template;
extern const std::string_view lobe_style;
extern const std::string_view lobe_script;

}  // namespace wend
