#pragma once

#include <string_view>

namespace wend {

/// What report_page fills for framed_page(): HTML with {{names}} for its parts.
extern const std::string_view report_template;

/// Its section on how renders of one way differ, around its {{rows}}.
extern const std::string_view report_spread;

/// The style sheet of all pages, and its script.
extern const std::string_view report_style;
extern const std::string_view report_script;

}  // namespace wend
