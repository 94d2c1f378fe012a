#include <wend/app/commands.h>
#include <wend/app/merged_renders.h>
#include <wend/app/picture_options.h>
#include <wend/app/session.h>
#include <wend/core/error.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <ostream>

namespace wend {
namespace {

struct MergeOptions {
    CommonOptions common;
    PictureOptions picture;
    std::string output;
    std::vector<std::string> inputs;
};

/// Who forgets the output names a render first, which must not be lost.
void require_no_other_render(const std::string& output, const RenderOrigins& origins) {
    std::vector<std::uint64_t> seeds;
    try {
        if (std::filesystem::is_regular_file(output)) {
            seeds = render_origin(output, read_picture(output)).seeds;
        }
    } catch (const InputError&) {
        return;  // no picture of Wend
    }
    if (seeds.size() == 1 && !origins.has_seed(seeds.front())) {
        throw InputError(Place{output},
                         fmt::format("there is a render with the seed {}, which none of the inputs has: the "
                                     "first name is that of the merged picture; remove the file if it may "
                                     "be replaced",
                                     seeds.front()));
    }
}

void note_result(const MergeOptions& options, const Streams& streams, const RenderOrigins& origins,
                 const MergedPictures& merged) {
    for (const std::string& layer : merged.left_out) {
        options.common.note(streams, "note: the layer '" + layer + "' is not in all pictures and is left out");
    }
    std::string shares;
    for (const double share : merged.shares) {
        shares += fmt::format(" {:.4f}", share);
    }
    options.common.note(streams, fmt::format("{}: {} spp of {} pictures with {} seeds, which count{}", options.output,
                                             origins.samples(), options.inputs.size(), origins.seeds(), shares));
    if (merged.empty > 0) {
        streams.err << "warning: " << merged.empty << " pixels have no sample in any picture and are black\n";
    }
}

void merge_files(const MergeOptions& options, const Streams& streams) {
    require_writable_picture(options.output);
    require_distinct(options.inputs, {options.output, options.common.json});
    const auto [merged, origins] = merge_renders(
        options.inputs.size(), [&](std::size_t k) { return options.inputs[k]; },
        [&](std::size_t k) {
            Picture picture = read_picture(options.inputs[k]);
            if (picture.metadata.count("wend:denoised") > 0) {
                throw InputError(Place{options.inputs[k]}, "a picture that was denoised cannot be merged");
            }
            return picture;
        });
    require_no_other_render(options.output, origins);
    write_picture(options.output, merged.picture, options.picture.format());
    note_result(options, streams, origins, merged);
    options.common.write_json(streams, {{"inputs", options.inputs},
                                        {"spp", origins.samples()},
                                        {"output", options.output},
                                        {"weights", merged.shares}});
}

}  // namespace

Action add_merge_command(CLI::App& program) {
    const auto options = std::make_shared<MergeOptions>();
    CLI::App& command = *program.add_subcommand("merge", "join renders of one picture with different seeds");
    command.add_option("output", options->output, "picture to write: .exr with layers and metadata, .png or .jpg")
        ->required();
    command.add_option("inputs", options->inputs, "pictures of 'wend render' (.exr), at least two")
        ->required()
        ->expected(2, CLI::detail::expected_max_vector_size);
    options->picture.add_to(command);
    options->common.add_to(command);
    return [options](const Streams& streams) { merge_files(*options, streams); };
}

}  // namespace wend
