#include <wend/app/merged_renders.h>
#include <wend/core/error.h>
#include <wend/film/flip.h>
#include <wend/film/metrics.h>
#include <wend/io/atomic_file.h>
#include <wend/io/colour_encoding.h>
#include <wend/io/image_file.h>

#include "bindings.h"

#include <nanobind/stl/variant.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>

namespace wend::python {
namespace {

using Layered = nb::ndarray<nb::numpy, float>;

/// The beauty, as long as the picture lives.
Layered image_of(Picture& picture) {
    return Layered(&picture.image.pixels.data()->r,
                   {static_cast<std::size_t>(picture.image.height), static_cast<std::size_t>(picture.image.width), 3},
                   nb::find(&picture));
}

Layered layer_of(Picture& picture, const std::string& name) {
    const auto found =
        std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& l) { return l.name == name; });
    if (found == picture.layers.end()) {
        throw nb::key_error(name.c_str());
    }
    return Layered(found->values.data(),
                   {static_cast<std::size_t>(picture.image.height), static_cast<std::size_t>(picture.image.width),
                    found->channels.size()},
                   nb::find(&picture));
}

std::vector<std::string> layer_names(const Picture& picture) {
    std::vector<std::string> names;
    for (const Layer& layer : picture.layers) {
        names.push_back(layer.name);
    }
    return names;
}

Picture picture_of(const Pixels& pixels) {
    Image image = to_image(pixels);
    const Vec2i size(image.width, image.height);
    return {std::move(image), {}, {}, {0, 0}, size};
}

/// The opacity, where it is not 1 everywhere, is a layer as files of OpenEXR have it: of 0 to 1, never encoded.
Picture picture_with_opacity(const std::filesystem::path& file) {
    ImageWithOpacity read = read_image_with_opacity(file);
    const Vec2i size(read.image.width, read.image.height);
    Picture picture{std::move(read.image), {}, {}, {0, 0}, size};
    if (!read.opacity.empty()) {
        if (is_png(file)) {
            // It was decoded as the colours were.
            std::transform(read.opacity.begin(), read.opacity.end(), read.opacity.begin(), &linear_to_srgb);
        }
        picture.layers.push_back({"alpha", {"A"}, std::move(read.opacity)});
    }
    return picture;
}

Values metrics_of(const Pixels& pixels, const Pixels& a, const Pixels& b) {
    const Image image = to_image(pixels);
    const Reference reference{to_image(a), to_image(b)};
    Metrics m;
    double difference = 0;
    {
        const nb::gil_scoped_release release;
        m = measure(image, reference);
        difference = flip(image, reference.average()).mean;
    }
    Values result;
    result["relmse"] = m.relmse;
    result["relmse_std_error"] = m.relmse_std_error;
    result["relmse_trimmed"] = m.relmse_trimmed;
    result["error_p9999"] = m.error_p9999;
    result["mse"] = m.mse;
    result["mape"] = m.mape;
    result["flip"] = difference;
    return result;
}

/// Joins renders, files or in memory; the picture, each one's share and the layers left out.
std::tuple<Picture, std::vector<double>, std::vector<std::string>> merge(
    const std::vector<std::variant<std::string, const Picture*>>& renders) {
    const nb::gil_scoped_release release;
    const auto name = [&](std::size_t k) {
        const auto* file = std::get_if<std::string>(&renders[k]);
        return file ? *file : "film " + std::to_string(k);
    };
    const auto read = [&](std::size_t k) {
        const auto* file = std::get_if<std::string>(&renders[k]);
        return file ? read_picture(*file) : *std::get<const Picture*>(renders[k]);
    };
    MergedRenders joined = merge_renders(renders.size(), name, read);
    return {std::move(joined.merged.picture), std::move(joined.merged.shares), std::move(joined.merged.left_out)};
}

}  // namespace

void bind_pictures(nb::module_& module) {
    nb::class_<Picture>(module, "Picture", "Colours, layers and metadata: what an OpenEXR file of Wend has.")
        .def_prop_ro("image", &image_of, "Linear RGB, (height, width, 3), float32; no copy.")
        .def_prop_ro("layer_names", &layer_names)
        .def("layer", &layer_of, nb::arg("name"), "(height, width, channels), float32; no copy.")
        .def_ro("metadata", &Picture::metadata)
        .def_prop_ro("offset", [](const Picture& p) { return std::pair(p.offset.x, p.offset.y); })
        .def_prop_ro("full_size", [](const Picture& p) { return std::pair(p.full_size.x, p.full_size.y); })
        .def(
            "save",
            [](const Picture& picture, const std::string& file, bool half, const std::string& layer_names,
               bool half_layers, bool alpha) {
                const nb::gil_scoped_release release;
                if (half) {
                    require_exr_extension(file);
                    require_writable(file);
                    write_colours(file, picture);
                } else {
                    require_known_picture_extension(file);
                    require_writable(file);
                    write_picture(file, picture, {parse_layer_names(layer_names), alpha, half_layers});
                }
            },
            nb::arg("file"), nb::arg("half"), nb::arg("layer_names"), nb::arg("half_layers"), nb::arg("alpha"))
        .def("png", [](const Picture& picture) {
            const std::string bytes = png_bytes(picture.image);
            return nb::bytes(bytes.data(), bytes.size());
        });
    module.def("picture_of", &picture_of, nb::arg("image"), "A picture of colours alone.");
    module.def(
        "read_picture",
        [](const std::string& file) {
            const nb::gil_scoped_release release;
            return read_picture(file);
        },
        nb::arg("file"));
    module.def(
        "read_image",
        [](const std::string& file) {
            const nb::gil_scoped_release release;
            return picture_with_opacity(file);
        },
        nb::arg("file"));
    module.def("metrics", &metrics_of, nb::arg("image"), nb::arg("a"), nb::arg("b"));
    module.def("merge", &merge, nb::arg("renders"));
}

}  // namespace wend::python
