#include <wend/app/commands.h>
#include <wend/app/comparison.h>
#include <wend/app/reference.h>
#include <wend/core/error.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

namespace wend {
namespace {

struct CompareOptions {
    CommonOptions common;
    SceneOptions scene;
    double seconds = 30;
    std::string sampling = "classical,direction,full";
    std::string reference;
    std::string folder;
    int seeds = 3;
};

void compare_scene(const CompareOptions& options, const Streams& streams) {
    std::vector<Preset> presets;
    for (const std::string& name : split_list(options.sampling)) {
        presets.push_back(parse_preset(name));
    }
    const std::filesystem::path scene = options.scene.file;
    const Reference reference = read_reference(options.reference.empty() ? scene.parent_path() / scene.stem()
                                                                         : std::filesystem::path(options.reference));
    if (!options.folder.empty()) {
        make_report_folder(options.folder);
    }
    const Session session(options.scene, options.common, streams);
    const auto rows =
        compare_presets(session, presets, options.seconds, options.seeds, reference, options.common, streams);
    if (!options.folder.empty()) {
        write_comparison(options.folder, session, rows, reference, options.seconds, options.seeds);
    }
    if (options.common.json != "-") {
        streams.out << comparison_table(rows) << std::flush;
    }
    options.common.write_json(streams, {{"settings", session.describe(session.settings())},
                                        {"seeds", options.seeds},
                                        {"time", options.seconds},
                                        {"rows", comparison_json(rows)}});
}

}  // namespace

Action add_compare_command(CLI::App& program) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App& command = *program.add_subcommand("compare", "compare ways of sampling in equal time");
    options->scene.add_to(command);
    command.add_option("--time", options->seconds, "seconds for each render, training included")
        ->check(seconds_problem)
        ->capture_default_str();
    command.add_option("--sampling", options->sampling, "ways to compare, separated by commas")->capture_default_str();
    command.add_option("--reference", options->reference,
                       "NAME of the pair NAME.ref-a.exr, NAME.ref-b.exr, or a picture (default: beside the scene)");
    command.add_option("--out", options->folder, "folder for pictures, error maps and index.html");
    command.add_option("--seeds", options->seeds, "renders of each, of which the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    options->common.add_to(command);
    return [options](const Streams& streams) { compare_scene(*options, streams); };
}

}  // namespace wend
