// A comparison to look at.
#pragma once

#include <wend/app/comparison.h>
#include <wend/core/image.h>
#include <wend/film/false_colour.h>

#include <string>

namespace wend {

/// The errors of a row's median run in false colours, as the page and the files beside it show them.
Image error_map(const ComparisonRow& row, const Reference& reference);

/// The page, pictures included.
std::string comparison_page(const Comparison& comparison);

}  // namespace wend
