// What all pages of the program have around what they show.
#pragma once

#include <string>
#include <string_view>

namespace wend {

/// A page (HTML) in one file, in the look of them all, light and dark. `title` is text; `style` is CSS beside what all
/// pages have; `body` is HTML.
std::string framed_page(std::string_view title, std::string_view style, std::string_view body);

/// The colour that stands for a position in 0..1 on all scales, as CSS writes it.
std::string hex_colour(float position);

/// CSS for bars that show a scale's colours: `<span class="bar"><i></i></span>`.
std::string bar_style();

}  // namespace wend
