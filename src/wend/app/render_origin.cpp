#include <wend/app/render_origin.h>

#include <wend/app/options.h>
#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/version.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

namespace wend {
namespace {

template <class Number>
std::optional<Number> parse_number(const std::string& text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && read == end ? std::optional(number) : std::nullopt;
}

/// The metadata of one file.
class Metadata {
public:
    Metadata(const std::string& file, const Picture& picture) : file_(file), values_(picture.metadata) {}

    [[noreturn]] void refuse(const std::string& message) const { throw InputError(Place{file_}, message); }

    std::optional<std::string> optional(const std::string& name) const {
        const auto found = values_.find("wend:" + name);
        return found == values_.end() ? std::nullopt : std::optional(found->second);
    }
    const std::string& text(const std::string& name) const {
        const auto found = values_.find("wend:" + name);
        if (found == values_.end()) {
            refuse("there are no metadata 'wend:" + name + "': only pictures that Wend has rendered can be merged");
        }
        return found->second;
    }
    template <class Number>
    Number number(const std::string& name) const {
        return number_of<Number>(name, text(name));
    }
    std::vector<std::uint64_t> seeds() const {
        std::vector<std::uint64_t> seeds;
        for (const std::string& part : split_list(text("seed"))) {
            seeds.push_back(number_of<std::uint64_t>("seed", part));
        }
        return seeds;
    }
    nlohmann::json object(const std::string& name) const {
        // Deeper ones would be written by as deep a recursion.
        constexpr int deepest = 8;
        const auto keep = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) { return depth <= deepest; };
        nlohmann::json parsed = nlohmann::json::parse(text(name), keep, false);
        if (!parsed.is_object()) {
            refuse("the metadata 'wend:" + name + "' are no JSON object");
        }
        return parsed;
    }

private:
    template <class Number>
    Number number_of(const std::string& name, const std::string& text) const {
        const std::optional<Number> number = parse_number<Number>(text);
        if (!number || !(static_cast<double>(*number) >= 0 && std::isfinite(static_cast<double>(*number)))) {
            refuse("the metadata 'wend:" + name + "' are no such number: '" + text + "'");
        }
        return *number;
    }

    const std::string& file_;
    const std::map<std::string, std::string>& values_;
};

[[noreturn]] void refuse_setting(const RenderOrigin& next, const RenderOrigin& before, const std::string& setting,
                                 const std::string& value, const std::string& other) {
    throw InputError(Place{next.file},
                     fmt::format("{} is {}, but {} in {}: only renders of the same picture can be merged", setting,
                                 value, other, before.file));
}

std::string name_of_scene(const RenderOrigin& origin) {
    return std::filesystem::path(origin.scene).filename().string();
}

/// JSON's null where there is none.
nlohmann::json max_depth_of(const RenderOrigin& origin) {
    return origin.settings.value("max_depth", nlohmann::json());
}

}  // namespace

RenderOrigin render_origin(const std::string& file, const Picture& picture) {
    const Metadata metadata(file, picture);
    const Vec2i& from = picture.offset;
    const Vec2i to = from + Vec2i(picture.image.width, picture.image.height);
    return {file,
            metadata.text("scene"),
            metadata.optional("scene_digest"),
            metadata.seeds(),
            metadata.number<std::uint64_t>("spp"),
            metadata.optional("seconds") ? std::optional(metadata.number<double>("seconds")) : std::nullopt,
            fmt::format("{}x{}", picture.full_size.x, picture.full_size.y),
            fmt::format("pixels {} to {} by {} to {}", from.x, to.x, from.y, to.y),
            metadata.object("settings")};
}

void RenderOrigins::require_same_scene(const RenderOrigin& next) const {
    if (next.digest && first_with_digest_) {
        if (*next.digest != *first_with_digest_->digest) {
            refuse_setting(next, *first_with_digest_, "the scene's content (wend:scene_digest)", *next.digest,
                           *first_with_digest_->digest);
        }
    } else if (name_of_scene(next) != name_of_scene(*first_)) {
        refuse_setting(next, *first_, "the scene", next.scene, first_->scene);
    }
}

void RenderOrigins::add(const RenderOrigin& next) {
    if (first_) {
        require_same_scene(next);
        if (next.resolution != first_->resolution) {
            refuse_setting(next, *first_, "the resolution", next.resolution, first_->resolution);
        }
        if (next.crop != first_->crop) {
            refuse_setting(next, *first_, "the crop", next.crop, first_->crop);
        }
        if (max_depth_of(next) != max_depth_of(*first_)) {
            refuse_setting(next, *first_, "max_depth", json_text(max_depth_of(next)), json_text(max_depth_of(*first_)));
        }
    }
    for (const std::uint64_t seed : next.seeds) {
        const auto [at, is_new] = file_of_seed_.emplace(seed, next.file);
        if (!is_new) {
            throw InputError(Place{next.file},
                             fmt::format("the seed {} is also that of {}: renders of one seed are not independent",
                                         seed, at->second));
        }
        seeds_.push_back(seed);
    }
    if (next.samples > std::numeric_limits<std::uint64_t>::max() - samples_) {
        throw InputError(Place{next.file}, "there are too many samples to count");
    }
    samples_ += next.samples;
    seconds_ = seconds_ && next.seconds ? std::optional(*seconds_ + *next.seconds) : std::nullopt;
    if (!first_) {
        first_ = next;
    }
    if (next.digest && !first_with_digest_) {
        first_with_digest_ = next;
    }
}

std::map<std::string, std::string> RenderOrigins::metadata() const {
    WEND_EXPECT(first_.has_value());
    nlohmann::json settings = first_->settings;
    settings["seed"] = seeds_;
    std::string seeds;
    for (const std::uint64_t seed : seeds_) {
        seeds += (seeds.empty() ? "" : ",") + std::to_string(seed);
    }
    std::map<std::string, std::string> metadata = {{"wend:scene", first_->scene},
                                                   {"wend:settings", json_text(settings)},
                                                   {"wend:seed", std::move(seeds)},
                                                   {"wend:version", WEND_VERSION},
                                                   {"wend:spp", std::to_string(samples_)}};
    if (seconds_) {
        metadata["wend:seconds"] = fmt::format("{}", *seconds_);
    }
    if (first_with_digest_) {
        metadata["wend:scene_digest"] = *first_with_digest_->digest;
    }
    return metadata;
}

}  // namespace wend
