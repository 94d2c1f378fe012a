#include <wend/app/commands.h>
#include <wend/app/comparison.h>
#include <wend/app/comparison_data.h>
#include <wend/app/comparison_files.h>
#include <wend/app/comparison_report.h>
#include <wend/app/gains.h>
#include <wend/app/progress.h>
#include <wend/app/reference.h>
#include <wend/app/reference_render.h>
#include <wend/app/report_folder.h>
#include <wend/core/error.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

struct CompareOptions {
    CommonOptions common;
    SceneOptions scene;  ///< without its file
    std::vector<std::string> scenes;
    double seconds = 30;
    std::string sampling = "classical,distance+direction,full";
    std::string subsurface = "classical";
    std::string reference;
    ReferenceEffort effort;  ///< of a reference that is rendered; nothing: the usual
    std::string folder;
    std::string report;
    int seeds = 3;

    bool has_effort() const { return effort.samples > 0 || effort.seconds > 0; }
    bool wants_rendered_reference() const { return reference == "render" || has_effort(); }
    bool reads_reference() const { return !reference.empty() && reference != "render"; }
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

/// What the scene's reference is called that is given by name: a folder has one for each scene. For one scene a pair of
/// that very name comes first.
std::filesystem::path given_reference(const CompareOptions& options, const std::filesystem::path& scene) {
    const std::filesystem::path name = options.reference;
    const bool is_pair = options.scenes.size() == 1 && std::filesystem::exists(reference_files(name).a);
    return std::filesystem::is_directory(name) && !is_pair ? name / scene.stem() : name;
}

/// Renders what the comparison judges by, for this reason; it is kept where there is a folder.
KnownReference make_reference(const CompareOptions& options, const Session& session, const std::string& reason,
                              const std::filesystem::path& folder, const Streams& streams) {
    const std::filesystem::path scene = session.scene_file();
    const std::filesystem::path name = folder.empty() ? folder : folder / scene.stem();
    const ReferenceEffort effort =
        options.has_effort() ? options.effort : ReferenceEffort{0, reference_effort * options.seconds};
    options.common.note(
        streams,
        fmt::format("{}rendering a reference, two halves of {} each{}", reason, to_string(effort),
                    name.empty() ? fmt::format(" ({} keeps it)", options.scenes.size() > 1 ? "--report" : "--out")
                                 : ", for --reference " + name.string() + " next time"));
    ProgressOfRenders bars(streams.err, !options.common.quiet);
    return render_reference(session, effort, name, [&](int half, const RenderProgress& progress) {
        bars.update(fmt::format("reference {}/2", half + 1), progress);
    });
}

/// The reference that is at hand, or else a rendered one. Throws InputError where the one at hand is of another size.
KnownReference judge(const CompareOptions& options, const Session& session, std::optional<KnownReference> at_hand,
                     const std::filesystem::path& folder, const Streams& streams) {
    if (options.wants_rendered_reference()) {
        return make_reference(options, session, "", folder, streams);
    }
    if (!at_hand) {
        const std::filesystem::path scene = session.scene_file();
        const std::string missing = what_is_missing(scene.parent_path() / scene.stem());
        return make_reference(options, session, missing + " beside the scene: ", folder, streams);
    }
    const PixelRect crop = session.new_film(session.settings()).crop();
    const std::string problem = size_problem(*at_hand, {crop.width(), crop.height()});
    if (!problem.empty()) {
        throw InputError(fmt::format("{}: choose --resolution {}x{}, another reference, or --reference render", problem,
                                     at_hand->size().x, at_hand->size().y));
    }
    return *std::move(at_hand);
}

/// `folder` is where files go; empty: none are written.
Comparison compare_scene(const CompareOptions& options, const ComparisonPlan& plan, const std::string& file,
                         const std::filesystem::path& folder, const Streams& streams) {
    const std::filesystem::path scene = file;
    std::optional<KnownReference> at_hand;
    if (options.reads_reference()) {
        at_hand = read_reference(given_reference(options, scene));
    } else if (!options.wants_rendered_reference()) {
        at_hand = read_reference_pair(scene.parent_path() / scene.stem());
    }
    if (!folder.empty()) {
        make_report_folder(folder);
    }
    SceneOptions scene_options = options.scene;
    scene_options.file = file;
    const Session session(scene_options, options.common, streams);
    KnownReference reference = judge(options, session, std::move(at_hand), folder, streams);
    const std::string label = options.scenes.size() > 1 ? scene.stem().string() + ": " : "";
    return compare_presets(session, plan, std::move(reference),
                           comparison_bars(plan.seeds, options.common, streams, label));
}

/// Throws InputError for what is wrong whatever the scenes hold.
void check(const CompareOptions& options) {
    std::vector<std::string> inputs = options.scenes;
    inputs.push_back(options.reference);
    require_distinct(inputs, {options.common.json});
    options.scene.check();
    const bool many = options.scenes.size() > 1;
    if (many && !options.folder.empty()) {
        throw InputError("--out is for one scene: --report makes a folder for each and a page over all of them");
    }
    if (many && options.reads_reference() && !std::filesystem::is_directory(options.reference)) {
        throw InputError("--reference " + options.reference +
                         ": for several scenes it is a folder with a pair for each, or render");
    }
    if (options.reads_reference() && options.has_effort()) {
        throw InputError("--reference-spp and --reference-time are for a reference that is rendered, and --reference " +
                         options.reference + " names one");
    }
    for (const std::string& scene : options.scenes) {
        if (!std::filesystem::exists(scene)) {
            throw InputError(Place{scene}, "does not exist");
        }
    }
}

void show(const CompareOptions& options, const ComparisonReport& report, const Streams& streams) {
    if (options.common.json == "-") {
        return;
    }
    const Comparison& last = report.comparisons().back();
    if (options.scenes.size() > 1) {
        streams.out << last.scene << '\n';
    }
    streams.out << comparison_table(last.rows) << std::flush;
    if (std::none_of(last.rows.begin(), last.rows.end(),
                     [](const ComparisonRow& row) { return row.way.is_classical(); })) {
        options.common.note(streams,
                            "no ratio: it is to --sampling classical with --subsurface classical, which was not among "
                            "them");
    }
}

/// One scene after the other; throws what is wrong with a lone one, and says at the end how many have failed of many.
void compare_scenes(const CompareOptions& options, const Streams& streams) {
    const ComparisonPlan plan{ways_to_compare(options), options.seconds, options.seeds};
    check(options);
    ComparisonReport report(options.report, options.scenes);
    bool is_input = true;
    for (std::size_t i = 0; i < options.scenes.size(); ++i) {
        const std::string& scene = options.scenes[i];
        try {
            const std::filesystem::path folder =
                options.folder.empty() ? report.folder_of(i) : std::filesystem::path(options.folder);
            Comparison comparison = compare_scene(options, plan, scene, folder, streams);
            if (!options.folder.empty()) {
                write_comparison(folder, comparison);
            }
            report.add(i, std::move(comparison));
            show(options, report, streams);
        } catch (const std::exception& error) {
            if (options.scenes.size() == 1) {
                throw;
            }
            streams.err << scene << ": " << failure_text(error) << '\n' << std::flush;
            is_input = is_input && dynamic_cast<const InputError*>(&error);
            report.add_failure(i, failure_text(error));
        }
    }
    if (options.scenes.size() > 1 && options.common.json != "-") {
        streams.out << '\n'
                    << gains_table(gain_distributions(report.comparisons()), report.comparisons()) << std::flush;
    }
    options.common.write_json(streams, report.json());
    if (!report.failed().empty()) {
        const std::string text = fmt::format("{} of {} scenes failed", report.failed().size(), options.scenes.size());
        is_input ? throw InputError(text) : throw std::runtime_error(text);
    }
}

}  // namespace

Action add_compare_command(CLI::App& program) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App& command = *program.add_subcommand("compare", "compare ways of sampling in equal time");
    command.add_option("scene", options->scenes, "pbrt-v4 scene files")->required();
    options->scene.add_choices_to(command);
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
                       fmt::format("NAME of the pair NAME.ref-a.exr, NAME.ref-b.exr, a picture, a folder with such "
                                   "pairs named as the scenes, or render (default: the pair beside the scene; where "
                                   "there is none, or with render, one is rendered by 'full', each half for {} times "
                                   "--time, and kept in the folder of --out or --report)",
                                   reference_effort));
    CLI::Option* samples =
        command.add_option("--reference-spp", options->effort.samples, "samples per pixel of each half: render one")
            ->check(CLI::Range(1, 1 << 30));
    command.add_option("--reference-time", options->effort.seconds, "seconds for each half: render one")
        ->check(seconds_problem)
        ->excludes(samples);
    CLI::Option* out = command.add_option("--out", options->folder,
                                          "folder for pictures, error maps, numbers and index.html, of one scene");
    command
        .add_option("--report", options->report,
                    "folder for a report over all scenes: how gains are distributed, and a folder as of --out for each")
        ->excludes(out);
    command.add_option("--seeds", options->seeds, "renders of each, of which the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    options->common.add_to(command);
    return [options](const Streams& streams) { compare_scenes(*options, streams); };
}

}  // namespace wend
