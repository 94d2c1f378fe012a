// What pictures are judged by: where it comes from, how large and how noisy it is.
#pragma once

#include <wend/core/vector.h>
#include <wend/film/metrics.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// The files of a reference's two halves: NAME.ref-a.exr and NAME.ref-b.exr.
struct ReferenceFiles {
    std::filesystem::path a, b;
};
ReferenceFiles reference_files(const std::filesystem::path& name);

/// How one half of a reference was rendered.
struct RenderedHalf {
    std::uint64_t seed = 0;
    int samples = 0;  ///< per pixel
    double seconds = 0;
};

/// A reference, and where it comes from.
struct KnownReference {
    Reference halves;
    std::vector<std::string> files = {};      ///< that hold it; none where it was rendered and not kept
    std::vector<RenderedHalf> rendered = {};  ///< its halves, where it was not read but rendered

    /// In pixels, of both halves.
    Vec2i size() const { return {halves.a.width, halves.a.height}; }
};

/// Reads the pair of a reference; nothing where one of the files is absent. Throws InputError for broken ones, and for
/// halves of different size.
std::optional<KnownReference> read_reference_pair(const std::filesystem::path& name);

/// What a pair lacks, in words, where it is not whole: "no room.ref-a.exr", or "room.ref-a.exr without room.ref-b.exr"
/// where one half is alone.
std::string what_is_missing(const std::filesystem::path& name);

/// Reads a reference: a pair, or one picture file that stands for both halves. Throws InputError if neither is there.
KnownReference read_reference(const std::filesystem::path& name);

/// What is wrong with judging a picture of so many pixels by the reference; empty: nothing. It names the reference's
/// file and both sizes.
std::string size_problem(const KnownReference& reference, const Vec2i& picture);

/// Where the reference comes from, its size, how its halves were rendered, and its own noise (noise_of()).
nlohmann::json reference_json(const KnownReference& reference);

}  // namespace wend
