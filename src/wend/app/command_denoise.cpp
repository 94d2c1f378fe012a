#include <wend/app/commands.h>
#include <wend/app/denoiser.h>
#include <wend/app/picture_options.h>
#include <wend/app/session.h>
#include <wend/core/error.h>
#include <wend/io/image_file.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>

namespace wend {
namespace {

struct DenoiseOptions {
    CommonOptions common;
    PictureOptions picture;
    std::string input, output, library;
};

void denoise(const DenoiseOptions& options, const Streams& streams) {
    require_writable_picture(options.output);
    require_distinct({options.input}, {options.output, options.common.json});
    const Denoiser denoiser(options.library, options.common.threads);
    const Picture picture = read_picture(options.input);
    if (picture.metadata.count("wend:denoised") > 0) {
        throw InputError(Place{options.input}, "the picture has been denoised already");
    }
    const Picture result = denoised(picture, denoiser);
    write_picture(options.output, result, options.picture.format());
    options.common.write_json(
        streams,
        {{"input", options.input}, {"output", options.output}, {"denoised", result.metadata.at("wend:denoised")}});
}

}  // namespace

Action add_denoise_command(CLI::App& program) {
    const auto options = std::make_shared<DenoiseOptions>();
    CLI::App& command = *program.add_subcommand("denoise", "take the noise out of a picture, by Open Image Denoise");
    command.add_option("input", options->input, "picture that 'wend render' wrote: an .exr with its layers")
        ->required();
    command
        .add_option("-o,--output", options->output,
                    "picture to write: an .exr keeps what was as the layer 'noisy'; .png or .jpg")
        ->required();
    command.add_option(
        "--oidn", options->library,
        "the library's file or folder (default: what WEND_OIDN names, the system's, or that of the Python "
        "package pyoidn)");
    options->picture.add_to(command);
    options->common.add_to(command);
    return [options](const Streams& streams) { denoise(*options, streams); };
}

}  // namespace wend
