#include <wend/view/questions.h>

#include <wend/core/error.h>
#include <wend/io/json_text.h>
#include <wend/view/pixel_report.h>

#include <fmt/format.h>
#include <half.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace wend {
namespace {

using Json = nlohmann::json;
using Kind = ViewCommand::Kind;

const std::vector<std::pair<const char*, Kind>>& commands() {
    static const std::vector<std::pair<const char*, Kind>> all = {
        {"pause", Kind::pause}, {"go_on", Kind::go_on},     {"more_seconds", Kind::more_seconds},
        {"save", Kind::save},   {"restart", Kind::restart}, {"stop", Kind::stop}};
    return all;
}

/// Layers that are made of others.
constexpr const char* beauty_name = "beauty";
constexpr const char* noise_name = "noise";

/// A member of a question. Throws InputError where it is missing or of another kind.
template <class T>
T member(const Json& question, const char* name) {
    const auto found = question.find(name);
    if (found == question.end()) {
        throw InputError(fmt::format("the question has no '{}'", name));
    }
    if constexpr (std::is_same_v<T, std::string>) {
        if (!found->is_string()) {
            throw InputError(fmt::format("'{}' is no text", name));
        }
    } else if constexpr (std::is_integral_v<T>) {
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() > (std::uint64_t{1} << 31)) {
            throw InputError(fmt::format("'{}' is no number of that kind", name));
        }
    } else if (!found->is_number() || !std::isfinite(found->get<double>())) {
        throw InputError(fmt::format("'{}' is no finite number", name));
    }
    return found->get<T>();
}

/// The relative standard error of each pixel, against at least a tenth of the mean.
Layer noise_layer(const Picture& picture, const Layer& variance) {
    const std::size_t channels = variance.channels.size();
    double mean = 0;
    for (const Rgb& pixel : picture.image.pixels) {
        mean += static_cast<double>(mean_value(pixel));
    }
    mean /= static_cast<double>(std::max<std::size_t>(1, picture.image.pixels.size()));
    const float least = std::max(1e-20f, static_cast<float>(0.1 * mean));
    Layer noise{noise_name, {"Y"}, {}};
    noise.values.reserve(picture.image.pixels.size());
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < channels; ++c) {
            sum += variance.values[i * channels + c];
        }
        noise.values.push_back(std::sqrt(sum / static_cast<float>(channels)) /
                               std::max(least, mean_value(picture.image.pixels[i])));
    }
    return noise;
}

const Layer* find_layer(const Picture& picture, const std::string& name) {
    const auto found = std::find_if(picture.layers.begin(), picture.layers.end(),
                                    [&](const Layer& layer) { return layer.name == name; });
    return found != picture.layers.end() ? &*found : nullptr;
}

/// Those of the picture, and those that are made of them.
Json all_layers(const ShownPicture& shown) {
    Json names = {beauty_name};
    if (std::find(shown.layers.begin(), shown.layers.end(), "variance") != shown.layers.end()) {
        names.push_back(noise_name);
    }
    for (const std::string& layer : shown.layers) {
        names.push_back(layer);
    }
    return names;
}

Json progress_json(const ShownPicture& shown) {
    const RenderProgress& p = shown.progress;
    return {{"fraction", json_number(p.fraction)},
            {"seconds", json_number(p.seconds)},
            {"left", json_number(p.seconds_left)},
            {"spp", p.samples},
            {"noise", p.samples > 1 ? json_number(p.relative_noise) : Json(nullptr)}};
}

Json picture_json(const ShownPicture& shown) {
    Json curve = Json::array();
    for (const NoisePoint& point : shown.curve) {
        curve.push_back({json_number(point.seconds), point.samples, json_number(point.noise)});
    }
    Json kinds = Json::array();
    for (const WalkKindStatistics& kind : shown.kinds) {
        kinds.push_back({{"name", to_string(kind.kind.preset)}, {"share", json_number(kind.share)}});
    }
    return {{"name", shown.name},
            {"phase", shown.phase},
            {"width", shown.size.x},
            {"height", shown.size.y},
            {"version", shown.version},
            {"layers", all_layers(shown)},
            {"progress", progress_json(shown)},
            {"curve", std::move(curve)},
            {"kinds", std::move(kinds)},
            {"is_guided", shown.fields != nullptr}};
}

Json state_json(const Board& board, const ViewOffer& offer) {
    Json pictures = Json::array();
    for (const ShownPicture& shown : board.pictures()) {
        pictures.push_back(picture_json(shown));
    }
    Json can = Json::array();
    for (const auto& [name, kind] : commands()) {
        if (std::find(offer.can.begin(), offer.can.end(), kind) != offer.can.end()) {
            can.push_back(name);
        }
    }
    return {{"title", offer.title},
            {"pictures", std::move(pictures)},
            {"can", std::move(can)},
            {"samplings", offer.samplings},
            {"note", board.note()}};
}

/// The picture as PictureBytes of questions.h says.
std::string picture_bytes(Json header, const float* values, std::size_t count) {
    std::string text = json_text(header);
    // Halves begin at an even place.
    text.append(text.size() % 2, ' ');
    const auto length = static_cast<std::uint32_t>(text.size());
    std::string bytes(sizeof(length) + text.size() + 2 * count, '\0');
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(bytes.data(), &length, sizeof(length));
    std::memcpy(bytes.data() + sizeof(length), text.data(), text.size());
    char* out = bytes.data() + sizeof(length) + text.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t half = imath_float_to_half(values[i]);
        std::memcpy(out + 2 * i, &half, sizeof(half));
    }
    return bytes;
}

Reply picture_reply(Board& board, const Json& question) {
    const auto index = member<std::uint32_t>(question, "of");
    const auto name = member<std::string>(question, "layer");
    const auto have = member<std::uint32_t>(question, "have");
    const bool is_beauty = name == beauty_name;
    board.want(index, have, !is_beauty);
    const ShownPicture shown = board.picture(index);
    if (!shown.picture || shown.version <= have) {
        return {"null", false};
    }
    const Picture& picture = *shown.picture;
    Json header = {{"of", index},
                   {"layer", name},
                   {"version", shown.version},
                   {"width", picture.image.width},
                   {"height", picture.image.height}};
    if (is_beauty) {
        header["channels"] = 3;
        static_assert(sizeof(Rgb) == 3 * sizeof(float));
        return {picture_bytes(std::move(header), &picture.image.pixels.front().r, 3 * picture.image.pixels.size()),
                true};
    }
    std::optional<Layer> noise;
    const Layer* layer = find_layer(picture, name);
    const Layer* variance = find_layer(picture, "variance");
    if (!layer && name == noise_name && variance) {
        noise = noise_layer(picture, *variance);
        layer = &*noise;
    }
    if (!layer) {
        return {"null", false};
    }
    header["channels"] = layer->channels.size();
    return {picture_bytes(std::move(header), layer->values.data(), layer->values.size()), true};
}

/// What each layer has at a pixel of the crop window.
Json layers_at(const Picture& picture, const Vec2i& pixel) {
    const std::size_t place = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(picture.image.width) +
                              static_cast<std::size_t>(pixel.x);
    const Rgb& colour = picture.image.pixels[place];
    Json values = {{beauty_name, {json_number(colour.r), json_number(colour.g), json_number(colour.b)}}};
    for (const Layer& layer : picture.layers) {
        Json& list = values[layer.name] = Json::array();
        for (std::size_t c = 0; c < layer.channels.size(); ++c) {
            list.push_back(json_number(layer.values[place * layer.channels.size() + c]));
        }
    }
    return values;
}

/// The pixel of a question, of the crop window. Throws InputError where it is outside.
Vec2i pixel_of(const ShownPicture& shown, const Json& question) {
    const Vec2i pixel(static_cast<int>(member<std::uint32_t>(question, "x")),
                      static_cast<int>(member<std::uint32_t>(question, "y")));
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= shown.size.x || pixel.y >= shown.size.y) {
        throw InputError(fmt::format("there is no pixel {},{}", pixel.x, pixel.y));
    }
    return pixel;
}

Json values_json(const Board& board, const Json& question) {
    const ShownPicture shown = board.picture(member<std::uint32_t>(question, "of"));
    const Vec2i pixel = pixel_of(shown, question);
    return {{"values", shown.picture ? layers_at(*shown.picture, pixel) : Json(nullptr)}};
}

Json pixel_json(const Board& board, const ViewOffer& offer, const Json& question) {
    const ShownPicture shown = board.picture(member<std::uint32_t>(question, "of"));
    const Vec2i pixel = pixel_of(shown, question);
    if (!offer.scene) {
        return {{"report", nullptr}};
    }
    PixelQuestion about;
    about.pixel = shown.offset + pixel;
    if (question.contains("distance")) {
        about.distance = static_cast<float>(member<double>(question, "distance"));
    }
    about.fields = shown.fields.get();
    about.records = shown.records.get();
    return {{"report", pixel_report(*offer.scene, about)}};
}

Json command_json(Board& board, const ViewOffer& offer, const std::string& asked, const Json& question) {
    const auto found =
        std::find_if(commands().begin(), commands().end(), [&](const auto& command) { return asked == command.first; });
    if (found == commands().end() || std::find(offer.can.begin(), offer.can.end(), found->second) == offer.can.end()) {
        throw InputError(fmt::format("'{}' cannot be asked here", asked));
    }
    ViewCommand command;
    command.kind = found->second;
    if (command.kind == Kind::more_seconds) {
        constexpr double longest = 1e6;
        command.seconds = member<double>(question, "seconds");
        if (!(command.seconds > 0 && command.seconds <= longest)) {
            throw InputError("'seconds' is out of range");
        }
    } else if (command.kind == Kind::restart) {
        command.picture = member<std::uint32_t>(question, "of");
        command.sampling = member<std::string>(question, "sampling");
        board.picture(command.picture);
        parse_preset(command.sampling);
    }
    board.post(std::move(command));
    return Json::object();
}

}  // namespace

Reply answer(Board& board, const ViewOffer& offer, std::string_view message) {
    try {
        const Json question = Json::parse(message, nullptr, false);
        if (!question.is_object()) {
            throw InputError("the question is no JSON object");
        }
        const auto asked = member<std::string>(question, "ask");
        if (asked == "picture") {
            return picture_reply(board, question);
        }
        return {json_text(asked == "state"    ? state_json(board, offer)
                          : asked == "values" ? values_json(board, question)
                          : asked == "pixel"  ? pixel_json(board, offer, question)
                                              : command_json(board, offer, asked, question)),
                false};
    } catch (const std::exception& error) {
        return {json_text({{"error", error.what()}}), false};
    }
}

}  // namespace wend
