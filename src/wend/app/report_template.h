#pragma once

#include <string_view>

namespace wend {

/// The page that report_page fills: HTML with {{names}} for its parts.
extern const std::string_view report_template;

/// Its section on how renders of one way differ, around its {{rows}}.
extern const std::string_view report_spread;

/// Its style sheet and its script.
extern const std::string_view report_style;
extern const std::string_view report_script;

}  // namespace wend
