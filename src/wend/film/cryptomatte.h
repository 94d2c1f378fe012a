// Which objects pixels show, in the way of Cryptomatte 1.2: numbers that are hashes of names, and how much of the pixel
// each covers, as layers that compositors make masks of.
#pragma once

#include <wend/film/picture.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// MurmurHash3 of 32 bits, with the seed 0.
std::uint32_t murmur_hash(std::string_view text);

/// What stands for a name: its hash, changed where as a float it were no ordinary number.
std::uint32_t cryptomatte_id(std::string_view name);

/// An object in a pixel, by its name's number.
struct Coverage {
    std::uint32_t id = 0;
    float part = 0;
};

/// The objects of one pixel.
class PixelCoverage {
public:
    void add(const Coverage& seen);
    const std::vector<Coverage>& objects() const { return objects_; }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& coverage) {
        bytes(coverage.objects_);
    }

private:
    std::vector<Coverage> objects_;
};

/// Of all layers of this kind, without a number behind.
inline constexpr const char* cryptomatte_name = "CryptoObject";

/// Layers CryptoObject00 to CryptoObject02, of two objects each: the six that cover most of a pixel, of coverages that
/// are divided by `scales`. Empty where there are no pixels.
std::vector<Layer> cryptomatte_layers(const std::vector<PixelCoverage>& pixels, const std::vector<float>& scales);

/// Whether a layer is one of them: numbers of names must not be averaged.
bool is_cryptomatte(const Layer& layer);

/// Adds what such a layer has in a pixel, times `weight`.
void add_coverage(const Layer& layer, std::size_t pixel, float weight, PixelCoverage& coverage);

/// Eight hexadecimal digits, as manifests have numbers.
std::string hexadecimal(std::uint32_t number);

}  // namespace wend
