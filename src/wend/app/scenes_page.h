// The comparisons of several scenes as a page to look at.
#pragma once

#include <wend/app/comparison_report.h>

#include <span>
#include <string>
#include <vector>

namespace wend {

/// What the page shows. Texts are plain: the page escapes them.
struct ScenesPage {
    std::span<const Comparison> comparisons;
    std::span<const std::string> thumbnails;  ///< bytes of PNG files, one for each comparison
    std::vector<std::string> links;           ///< to the page of each comparison, relative to this one
    std::span<const FailedScene> failed;
    std::size_t wanted = 0;  ///< scenes in all, with those to come
};

/// One HTML page that needs no other file and no network, but for the links to the scenes' own pages: how gains are
/// distributed, the worst cases first, and a section for each scene.
std::string scenes_page(const ScenesPage& page);

}  // namespace wend
