#include <wend/app/commands.h>
#include <wend/app/comparison.h>
#include <wend/app/comparison_page.h>
#include <wend/app/progress.h>
#include <wend/app/reference.h>
#include <wend/app/reference_render.h>
#include <wend/app/report_folder.h>
#include <wend/core/error.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>

namespace wend {
namespace {

struct CompareOptions {
    CommonOptions common;
    SceneOptions scene;
    double seconds = 30;
    std::string sampling = "classical,distance+direction,full";
    std::string subsurface = "classical";
    std::string reference;
    std::string folder;
    int seeds = 3;
};

/// Presets separated by commas, "ablation" standing for many of them; each of them once.
std::vector<Preset> parse_presets(const std::string& text) {
    std::vector<Preset> presets;
    for (const std::string& name : split_list(text)) {
        for (const Preset& preset : name == "ablation" ? ablation_presets() : std::vector{parse_preset(name)}) {
            if (std::find(presets.begin(), presets.end(), preset) == presets.end()) {
                presets.push_back(preset);
            }
        }
    }
    return presets;
}

/// Every preset with every subsurface sampling.
std::vector<WayOfSampling> ways_to_compare(const CompareOptions& options) {
    std::vector<WayOfSampling> ways;
    for (const Preset& preset : parse_presets(options.sampling)) {
        for (const std::string& name : split_list(options.subsurface)) {
            ways.push_back({preset, parse_subsurface(name)});
        }
    }
    return ways;
}

/// Renders what the comparison judges by; it is kept where there is a folder.
Reference make_reference(const Session& session, const CompareOptions& options, const Streams& streams) {
    const std::filesystem::path scene = options.scene.file;
    const std::filesystem::path name =
        options.folder.empty() ? std::filesystem::path() : std::filesystem::path(options.folder) / scene.stem();
    options.common.note(
        streams, fmt::format("{} beside the scene: rendering a reference, two halves of {:g} s each{}",
                             what_is_missing(scene.parent_path() / scene.stem()), reference_effort * options.seconds,
                             name.empty() ? " (--out keeps it)" : ", for --reference " + name.string() + " next time"));
    ProgressOfRenders bars(streams.err, !options.common.quiet);
    return render_reference(session, options.seconds, name, [&](int half, const RenderProgress& progress) {
        bars.update(fmt::format("reference {}/2", half + 1), progress);
    });
}

void compare_scene(const CompareOptions& options, const Streams& streams) {
    const std::vector<WayOfSampling> ways = ways_to_compare(options);
    const std::filesystem::path scene = options.scene.file;
    require_distinct({options.scene.file, options.reference}, {options.common.json});
    std::optional<Reference> reference = options.reference.empty()
                                             ? read_reference_pair(scene.parent_path() / scene.stem())
                                             : read_reference(options.reference);
    if (!options.folder.empty()) {
        make_report_folder(options.folder);
    }
    const Session session(options.scene, options.common, streams);
    if (!reference) {
        reference = make_reference(session, options, streams);
    }
    const auto rows = compare_presets(session, ways, options.seconds, options.seeds, *reference,
                                      comparison_bars(options.seeds, options.common, streams));
    if (!options.folder.empty()) {
        write_comparison(options.folder, session, rows, *reference, options.seconds, options.seeds);
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
    command
        .add_option("--sampling", options->sampling,
                    "ways to compare, separated by commas; ablation: each decision alone, and all but each")
        ->capture_default_str();
    command
        .add_option("--subsurface", options->subsurface,
                    "each with these walks inside dense media, separated by commas: " + subsurface_names())
        ->capture_default_str();
    command.add_option("--reference", options->reference,
                       fmt::format("NAME of the pair NAME.ref-a.exr, NAME.ref-b.exr, or a picture (default: the pair "
                                   "beside the scene; where there is none, one is rendered by 'full', each half for {} "
                                   "times --time, and kept in the folder of --out)",
                                   reference_effort));
    command.add_option("--out", options->folder, "folder for pictures, error maps and index.html");
    command.add_option("--seeds", options->seeds, "renders of each, of which the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    options->common.add_to(command);
    return [options](const Streams& streams) { compare_scene(*options, streams); };
}

}  // namespace wend
