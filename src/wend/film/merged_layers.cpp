#include <wend/film/merged_layers.h>

#include <wend/core/error.h>
#include <wend/film/film_layers.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace wend {

const Layer* find_layer(const std::vector<Layer>& layers, const std::string& name) {
    const auto found = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
    return found == layers.end() ? nullptr : &*found;
}

const Layer& same_layer(const Picture& picture, const Layer& layer) {
    const Layer* const other = find_layer(picture.layers, layer.name);
    if (!other || other->channels != layer.channels) {
        throw InputError("the layer '" + layer.name + "' is not what it was: the file has changed");
    }
    return *other;
}

PartMeans::PartMeans(std::vector<Layer>& layers) {
    for (Layer& layer : layers) {
        if (counts_as_beauty(layer.name)) {
            parts_.push_back({&layer, std::vector<double>(layer.values.size())});
        }
    }
}

void PartMeans::add(const Picture& picture, const std::vector<double>& weights, const std::vector<double>& totals) {
    for (Part& part : parts_) {
        const Layer& other = same_layer(picture, *part.layer);
        const std::size_t channels = other.channels.size();
        for (std::size_t k = 0; k < part.means.size(); ++k) {
            if (const double w = weights[k / channels]; w > 0) {
                part.means[k] += (static_cast<double>(other.values[k]) - part.means[k]) * w / totals[k / channels];
            }
        }
    }
}

void PartMeans::put() const {
    for (const Part& part : parts_) {
        std::transform(part.means.begin(), part.means.end(), part.layer->values.begin(),
                       [](double mean) { return static_cast<float>(mean); });
    }
}

MergedObjects::MergedObjects(std::vector<Layer>& layers) {
    for (Layer& layer : layers) {
        if (is_cryptomatte(layer)) {
            layers_.push_back(&layer);
            pixels_.resize(layer.values.size() / layer.channels.size());
        }
    }
}

void MergedObjects::add(const Picture& picture, const std::vector<float>& shares) {
    for (const Layer* layer : layers_) {
        const Layer& other = same_layer(picture, *layer);
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            if (shares[i] > 0) {
                add_coverage(other, i, shares[i], pixels_[i]);
            }
        }
    }
}

void MergedObjects::put() const {
    const std::vector<Layer> merged = cryptomatte_layers(pixels_, std::vector<float>(pixels_.size(), 1.0f));
    for (Layer* layer : layers_) {
        if (const Layer* found = find_layer(merged, layer->name)) {
            layer->values = found->values;
        }
    }
}

}  // namespace wend
