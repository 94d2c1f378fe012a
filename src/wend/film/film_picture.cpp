#include <wend/film/film.h>

#include <wend/film/each_pixel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace wend {

namespace {

/// A layer with room for the values of all pixels.
Layer empty_layer(const char* name, std::vector<std::string> channels, std::size_t pixels) {
    const std::size_t values = channels.size() * pixels;
    return {name, std::move(channels), std::vector<float>(values)};
}

/// An initializer list would copy them.
template <class... Layers>
std::vector<Layer> list_of(Layers... layers) {
    std::vector<Layer> list;
    (list.push_back(std::move(layers)), ...);
    return list;
}

}  // namespace

Picture Film::picture() const {
    const Halves weights = stage_weights();
    const std::size_t size = pixels_.size();
    Picture picture;
    picture.image = beauty(weights);
    picture.offset = crop_.min;
    picture.full_size = full_size_;
    Layer albedo = empty_layer("albedo", {"R", "G", "B"}, size);
    Layer normal = empty_layer("normal", {"X", "Y", "Z"}, size);
    Layer depth = empty_layer("depth", {"Z"}, size);
    Layer alpha = empty_layer("alpha", {"A"}, size);
    Layer samples = empty_layer("samples", {"N"}, size);
    Layer variance = empty_layer("variance", {"R", "G", "B"}, size);
    for_each_pixel(crop_, [&](std::size_t i) {
        const Pixel& p = pixels_[i];
        const auto n = static_cast<float>(std::max(p.featured, 1u));
        for (std::size_t c = 0; c < 3; ++c) {
            albedo.values[3 * i + c] = p.albedo[c] / n;
            normal.values[3 * i + c] = p.normal[c] / n;
            variance.values[3 * i + c] = static_cast<float>(p.spread(static_cast<int>(c), weights[half_of(i)]));
        }
        depth.values[i] = p.depth / n;
        alpha.values[i] = p.alpha / n;
        samples.values[i] = static_cast<float>(p.samples());
    });
    picture.layers = list_of(std::move(albedo), std::move(normal), std::move(depth), std::move(samples),
                             std::move(variance), std::move(alpha));
    for (std::vector<Layer>& more :
         std::array{walk_layers(), part_layers(weights), half_layers(weights), geometry_layers(), object_layers()}) {
        std::move(more.begin(), more.end(), std::back_inserter(picture.layers));
    }
    return picture;
}

std::vector<Layer> Film::walk_layers() const {
    const std::size_t size = pixels_.size();
    Layer scatter = empty_layer("scatter", {"P"}, size);
    Layer segments = empty_layer("segments", {"N"}, size);
    Layer branches = empty_layer("branches", {"N"}, size);
    Layer guided = empty_layer("guided", {"P"}, size);
    for_each_pixel(crop_, [&](std::size_t i) {
        const Pixel& p = pixels_[i];
        const double scale = p.samples() > 0 ? 1.0 / p.samples() : 0.0;
        scatter.values[i] = p.opacity / static_cast<float>(std::max(p.featured, 1u));
        guided.values[i] = static_cast<float>(p.guided * scale);
        segments.values[i] = static_cast<float>(static_cast<double>(p.segments) * scale);
        branches.values[i] = static_cast<float>(static_cast<double>(p.branches) * scale);
    });
    return list_of(std::move(scatter), std::move(segments), std::move(branches), std::move(guided));
}

std::vector<Layer> Film::part_layers(const Halves& weights) const {
    std::vector<Layer> layers;
    for (std::size_t part = 0; part < layers_.parts.size(); ++part) {
        Layer& layer = layers.emplace_back(Layer{layers_.parts[part], {"R", "G", "B"}, {}});
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const double weight = weights[half_of(i)], total = pixels_[i].weight(weight);
            for (std::size_t c = 0; c < 3; ++c) {
                layer.values.push_back(total > 0 ? static_cast<float>(parts_.sum(i, part, c, weight) / total) : 0.0f);
            }
        }
    }
    return layers;
}

std::vector<Layer> Film::half_layers(const Halves& weights) const {
    if (!layers_.halves) {
        return {};
    }
    const std::size_t part = layers_.parts.size();
    Layer a{"half_a", {"R", "G", "B"}, {}}, b{"half_b", {"R", "G", "B"}, {}};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Pixel& p = pixels_[i];
        const double weight = weights[half_of(i)], total = p.weight(weight);
        // With the share s of half a, the difference of the means times this is sqrt(s (1 - s)) of it.
        const double share = total > 0 ? parts_.sum(i, part + 1, 0, weight) / total : 0.0;
        const double scale = share > 0 && share < 1 ? 1 / std::sqrt(share * (1 - share)) : 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double mean = p.mean(static_cast<int>(c), weight);
            const double of_a = total > 0 ? parts_.sum(i, part, c, weight) / total : 0.0;
            const double difference = scale * (of_a - share * mean);
            a.values.push_back(static_cast<float>(mean + difference));
            b.values.push_back(static_cast<float>(mean - difference));
        }
    }
    return list_of(std::move(a), std::move(b));
}

std::vector<Layer> Film::geometry_layers() const {
    if (geometry_.empty()) {
        return {};
    }
    Layer position{"position", {"X", "Y", "Z"}, {}}, face_normal{"face_normal", {"X", "Y", "Z"}, {}};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const auto n = static_cast<float>(std::max(pixels_[i].featured, 1u));
        for (int c = 0; c < 3; ++c) {
            position.values.push_back(geometry_[i].position[c] / n);
            face_normal.values.push_back(geometry_[i].face_normal[c] / n);
        }
    }
    return list_of(std::move(position), std::move(face_normal));
}

std::vector<Layer> Film::object_layers() const {
    if (coverage_.empty()) {
        return {};
    }
    std::vector<float> rays;
    for (const Pixel& pixel : pixels_) {
        rays.push_back(static_cast<float>(std::max(pixel.featured, 1u)));
    }
    return cryptomatte_layers(coverage_, rays);
}

bool counts_as_beauty(const std::string& layer) {
    constexpr std::array<std::string_view, 7> parts{"emission", "background", "direct", "indirect",
                                                    "volume",   "half_a",     "half_b"};
    return layer.starts_with(light_group_prefix) || std::find(parts.begin(), parts.end(), layer) != parts.end();
}

}  // namespace wend
