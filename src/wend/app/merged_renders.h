// Renders of one picture that are joined to one.
#pragma once

#include <wend/app/render_origin.h>
#include <wend/film/merge.h>

#include <cstddef>
#include <functional>
#include <string>

namespace wend {

struct MergedRenders {
    MergedPictures merged;  ///< its picture with the metadata of all
    RenderOrigins origins;
};

/// Joins pictures of `wend render` as merge_pictures() does; `name` says what messages call the k-th. Throws InputError
/// where they are not independent estimates of the same picture.
MergedRenders merge_renders(std::size_t count, const std::function<std::string(std::size_t)>& name,
                            const std::function<Picture(std::size_t)>& read);

}  // namespace wend
