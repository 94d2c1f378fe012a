// The text of the page of lobes around its data.
#pragma once

#include <string_view>

namespace wend {

/// HTML, beside the style of report_template.h: {{title}}, {{report_style}}, {{style}}, {{gradient}}, {{file}},
/// {{options}}, {{low}}, {{high}}, {{flight}}, {{places}}, {{data}}, {{script}}.
extern const std::string_view lobe_template;
extern const std::string_view lobe_style;
extern const std::string_view lobe_script;

}  // namespace wend
