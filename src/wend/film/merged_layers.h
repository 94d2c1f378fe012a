// Layers of merged pictures that are no means over samples: see merge_pictures().
#pragma once

#include <wend/film/cryptomatte.h>
#include <wend/film/picture.h>

#include <string>
#include <vector>

namespace wend {

/// Null where there is none of that name.
const Layer* find_layer(const std::vector<Layer>& layers, const std::string& name);

/// The same layer of another picture. Throws InputError where the file has changed since the first look at it.
const Layer& same_layer(const Picture& picture, const Layer& layer);

/// Means of the layers that count as the beauty does.
class PartMeans {
public:
    /// Refers to the layers, which have their size.
    explicit PartMeans(std::vector<Layer>& layers);

    /// `weights` are those of the picture's pixels, `totals` with those of the pictures before.
    void add(const Picture& picture, const std::vector<double>& weights, const std::vector<double>& totals);
    /// Writes the means into the layers.
    void put() const;

private:
    struct Part {
        Layer* layer;
        std::vector<double> means;
    };
    std::vector<Part> parts_;
};

/// Objects of Cryptomatte: each counts for itself.
class MergedObjects {
public:
    /// Refers to the layers, which have their size.
    explicit MergedObjects(std::vector<Layer>& layers);

    /// `shares` are what the picture's pixels count of all.
    void add(const Picture& picture, const std::vector<float>& shares);
    /// Writes those that cover most into the layers.
    void put() const;

private:
    std::vector<Layer*> layers_;
    std::vector<PixelCoverage> pixels_;
};

}  // namespace wend
