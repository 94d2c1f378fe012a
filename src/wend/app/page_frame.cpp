#include <wend/app/page_frame.h>

#include <wend/app/markup.h>
#include <wend/app/report_template.h>
#include <wend/film/false_colour.h>
#include <wend/film/tone.h>

#include <fmt/format.h>

namespace wend {
namespace {

constexpr std::string_view frame = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{{title}}</title>
<style>{{report_style}}{{style}}</style>
</head>
<body>
{{body}}</body>
</html>
)html";

}  // namespace

std::string framed_page(std::string_view title, std::string_view style, std::string_view body) {
    return fill_template(frame, {{"title", escape_markup(title)},
                                 {"report_style", std::string(report_style)},
                                 {"style", std::string(style)},
                                 {"body", std::string(body)}});
}

std::string hex_colour(float position) {
    const Rgb colour = false_colour(position);
    return fmt::format("#{:02x}{:02x}{:02x}", encode_srgb(colour.r), encode_srgb(colour.g), encode_srgb(colour.b));
}

std::string bar_style() {
    constexpr int steps = 16;
    std::string colours;
    for (int i = 0; i <= steps; ++i) {
        colours += "," + hex_colour(static_cast<float>(i) / steps);
    }
    return "\n.bar i { background: linear-gradient(to right" + colours + "); }\n";
}

}  // namespace wend
