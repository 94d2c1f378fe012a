#include <wend/app/picture_options.h>

#include <CLI/CLI.hpp>

namespace wend {

void PictureOptions::add_to(CLI::App& command) {
    command
        .add_option(
            "--layer-names", names,
            "how an .exr calls its channels: wend (depth.Z), pbrt (as its GBufferFilm: Ns.X) or blender (as its "
            "multilayer files: ViewLayer.Depth.Z)")
        ->check(CLI::IsMember({"wend", "pbrt", "blender"}))
        ->capture_default_str();
    command
        .add_option("--exr", numbers,
                    "what an .exr has its colours in: float, as merging and measuring want, or half, which takes half "
                    "the space; what is no colour stays float")
        ->check(CLI::IsMember({"float", "half"}))
        ->capture_default_str();
    command.add_flag("--alpha", alpha,
                     "write alpha as channel A of an .exr's picture, as compositors take it, and not as a layer");
}

PictureFormat PictureOptions::format() const {
    return {parse_layer_names(names), alpha, numbers == "half"};
}

}  // namespace wend
