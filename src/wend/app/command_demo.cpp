#include <wend/app/commands.h>
#include <wend/app/comparison.h>
#include <wend/app/comparison_data.h>
#include <wend/app/comparison_files.h>
#include <wend/app/reference.h>
#include <wend/app/report_folder.h>
#include <wend/core/error.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>
#include <ostream>
#include <utility>

namespace wend {
namespace {

struct DemoOptions {
    CommonOptions common;
    double seconds = 20;
    std::string folder = "demo";
    std::string scenes;
};

/// The folder of the scenes that come with the program: beside it where it is installed, or above it in a source tree.
std::filesystem::path find_scenes() {
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    const std::filesystem::path installed = folder / ".." / "share" / "wend" / "scenes";
    if (std::filesystem::exists(installed / "demo.pbrt")) {
        return installed;
    }
    for (; folder.has_relative_path(); folder = folder.parent_path()) {
        if (std::filesystem::exists(folder / "scenes" / "demo.pbrt")) {
            return folder / "scenes";
        }
    }
    throw InputError("the demo scene was not found beside the program: name its folder with --scenes");
}

void run_demo(const DemoOptions& options, const Streams& streams) {
    const std::filesystem::path scenes = options.scenes.empty() ? find_scenes() : std::filesystem::path(options.scenes);
    SceneOptions scene;
    scene.file = (scenes / "demo.pbrt").string();
    KnownReference reference = read_reference(scenes / "demo");
    make_report_folder(options.folder);
    const Session session(scene, options.common, streams);
    const ComparisonPlan plan{{WayOfSampling{}, WayOfSampling{parse_preset("full"), {}}}, options.seconds, 3};
    options.common.note(streams, fmt::format("rendering {} for {:g} s classically and {:g} s guided, {} times",
                                             scene.file, options.seconds, options.seconds, plan.seeds));
    const Comparison comparison =
        compare_presets(session, plan, std::move(reference), comparison_bars(plan.seeds, options.common, streams));
    write_comparison(options.folder, comparison);
    if (options.common.json != "-") {
        streams.out << comparison_table(comparison.rows) << "\npictures and the page index.html are in "
                    << options.folder << '\n'
                    << std::flush;
    }
    options.common.write_json(streams, {{"rows", comparison_json(comparison)}});
}

}  // namespace

Action add_demo_command(CLI::App& program) {
    const auto options = std::make_shared<DemoOptions>();
    CLI::App& command =
        *program.add_subcommand("demo", "render a built-in scene classically and guided, in equal time");
    command.add_option("--time", options->seconds, "seconds for each render")
        ->check(seconds_problem)
        ->capture_default_str();
    command.add_option("--out", options->folder, "folder for pictures, error map and index.html")
        ->capture_default_str();
    command.add_option("--scenes", options->scenes, "folder of demo.pbrt and its reference");
    options->common.add_to(command);
    return [options](const Streams& streams) { run_demo(*options, streams); };
}

}  // namespace wend
