#include <wend/app/merged_renders.h>

#include <wend/app/manifest.h>
#include <wend/core/error.h>
#include <wend/film/cryptomatte.h>
#include <wend/io/spectrum/colour_space.h>

#include <algorithm>
#include <map>

namespace wend {

MergedRenders merge_renders(std::size_t count, const std::function<std::string(std::size_t)>& name,
                            const std::function<Picture(std::size_t)>& read) {
    MergedRenders result;
    std::size_t current = 0, known = 0;
    std::map<std::string, std::string> manifest;
    std::map<std::string, std::string> spaces;  // none where colours are those of sRGB
    const auto read_once_more = [&](std::size_t k) {
        current = k;
        Picture picture = read(k);
        if (k == known) {
            result.origins.add(render_origin(name(k), picture));
            add_manifest(picture.metadata, manifest);
            if (const auto space = picture.metadata.find(std::string(colour_space_text));
                space != picture.metadata.end()) {
                spaces.insert(*space);
            }
            ++known;
        }
        return picture;
    };
    try {
        result.merged = merge_pictures(count, read_once_more);
    } catch (const InputError& error) {
        const std::string what = error.what();
        throw what.starts_with(name(current)) ? error : InputError(Place{name(current)}, what);
    }
    Picture& picture = result.merged.picture;
    picture.metadata = result.origins.metadata();
    picture.metadata.merge(spaces);
    if (std::any_of(picture.layers.begin(), picture.layers.end(), is_cryptomatte)) {
        add_manifest(manifest, picture.metadata);
    }
    return result;
}

}  // namespace wend
