#include <wend/app/manifest.h>

#include <wend/app/options.h>
#include <wend/film/cryptomatte.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

namespace wend {
namespace {

using nlohmann::json;

/// The metadata of layers of that name begin so, with seven digits of the name's hash.
std::string key_of(const std::string& what) {
    return "cryptomatte/" + hexadecimal(murmur_hash(cryptomatte_name)).substr(0, 7) + '/' + what;
}

std::set<std::uint32_t> ids_in(const Picture& picture) {
    std::set<std::uint32_t> ids;
    for (const Layer& layer : picture.layers) {
        for (std::size_t i = 0; i < picture.image.pixels.size() && is_cryptomatte(layer); ++i) {
            PixelCoverage coverage;
            add_coverage(layer, i, 1, coverage);
            for (const Coverage& object : coverage.objects()) {
                ids.insert(object.id);
            }
        }
    }
    return ids;
}

}  // namespace

void add_manifest(const Scene& scene, const ObjectIds& ids, Picture& picture) {
    if (!std::any_of(picture.layers.begin(), picture.layers.end(), is_cryptomatte)) {
        return;
    }
    const std::set<std::uint32_t> shown = ids_in(picture);
    const ObjectNames& names = scene.description().names;
    json manifest = json::object();
    for (std::size_t i = 0; i < ids.of_surfaces.size(); ++i) {
        if (shown.count(ids.of_surfaces[i]) > 0) {
            manifest[names.surface(i)] = hexadecimal(ids.of_surfaces[i]);
        }
    }
    for (std::size_t i = 0; i < ids.of_media.size(); ++i) {
        if (shown.count(ids.of_media[i]) > 0) {
            manifest[names.medium(i)] = hexadecimal(ids.of_media[i]);
        }
    }
    picture.metadata[key_of("name")] = cryptomatte_name;
    picture.metadata[key_of("hash")] = "MurmurHash3_32";
    picture.metadata[key_of("conversion")] = "uint32_to_float32";
    picture.metadata[key_of("manifest")] = json_text(manifest);
}

void add_manifest(const std::map<std::string, std::string>& other, std::map<std::string, std::string>& metadata) {
    const std::string key = key_of("manifest");
    for (const auto& [name, text] : other) {
        if (!name.starts_with("cryptomatte/")) {
            continue;
        }
        const auto [known, is_new] = metadata.try_emplace(name, text);
        if (!is_new && name == key) {
            json all = json::parse(known->second, nullptr, false);
            const json more = json::parse(text, nullptr, false);
            if (all.is_object() && more.is_object()) {
                all.update(more);
                known->second = json_text(all);
            }
        }
    }
}

}  // namespace wend
