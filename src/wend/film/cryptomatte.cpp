#include <wend/film/cryptomatte.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace wend {
namespace {

constexpr std::size_t levels = 3, objects_of_level = 2;
const std::vector<std::string> channels = {"r", "g", "b", "a"};

std::uint32_t little_endian(std::string_view bytes) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        word |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    }
    return word;
}

std::uint32_t scrambled(std::uint32_t word) {
    return std::rotl(word * 0xcc9e2d51u, 15) * 0x1b873593u;
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
    std::uint32_t h = 0;
    std::string_view rest = text;
    for (; rest.size() >= 4; rest.remove_prefix(4)) {
        h = std::rotl(h ^ scrambled(little_endian(rest.substr(0, 4))), 13) * 5 + 0xe6546b64u;
    }
    h ^= scrambled(little_endian(rest));
    h ^= static_cast<std::uint32_t>(text.size());
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

std::uint32_t cryptomatte_id(std::string_view name) {
    const std::uint32_t hash = murmur_hash(name);
    const std::uint32_t exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ (1u << 23) : hash;
}

void PixelCoverage::add(const Coverage& seen) {
    const auto found =
        std::find_if(objects_.begin(), objects_.end(), [&](const Coverage& known) { return known.id == seen.id; });
    if (found != objects_.end()) {
        found->part += seen.part;
    } else {
        objects_.push_back(seen);
    }
}

std::vector<Layer> cryptomatte_layers(const std::vector<PixelCoverage>& pixels, const std::vector<float>& scales) {
    std::vector<Layer> layers;
    for (std::size_t level = 0; level < levels && !pixels.empty(); ++level) {
        layers.push_back({std::string(cryptomatte_name) + '0' + std::to_string(level), channels,
                          std::vector<float>(channels.size() * pixels.size())});
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        std::vector<Coverage> objects = pixels[i].objects();
        std::sort(objects.begin(), objects.end(), [](const Coverage& a, const Coverage& b) {
            return a.part != b.part ? a.part > b.part : a.id < b.id;
        });
        for (std::size_t rank = 0; rank < std::min(objects.size(), levels * objects_of_level); ++rank) {
            float* const values =
                &layers[rank / objects_of_level].values[channels.size() * i + 2 * (rank % objects_of_level)];
            values[0] = std::bit_cast<float>(objects[rank].id);
            values[1] = objects[rank].part / scales[i];
        }
    }
    return layers;
}

bool is_cryptomatte(const Layer& layer) {
    return layer.name.starts_with(cryptomatte_name) && layer.channels == channels;
}

void add_coverage(const Layer& layer, std::size_t pixel, float weight, PixelCoverage& coverage) {
    for (std::size_t k = 0; k < objects_of_level; ++k) {
        const float* const values = &layer.values[channels.size() * pixel + 2 * k];
        if (values[1] > 0) {
            coverage.add({std::bit_cast<std::uint32_t>(values[0]), weight * values[1]});
        }
    }
}

std::string hexadecimal(std::uint32_t number) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text(8, '0');
    for (auto digit = text.rbegin(); digit != text.rend(); ++digit, number >>= 4) {
        *digit = digits[number & 15];
    }
    return text;
}

}  // namespace wend
