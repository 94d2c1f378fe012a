#include <wend/app/commands.h>
#include <wend/app/interrupt.h>
#include <wend/app/live_renders.h>
#include <wend/app/live_view.h>
#include <wend/core/error.h>
#include <wend/io/image_file.h>
#include <wend/view/page.h>
#include <wend/view/questions.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <ostream>
#include <thread>

namespace wend {
namespace {

struct ViewOptions {
    CommonOptions common;
    SceneOptions scene;
    std::vector<std::string> files;
    std::string sampling = "full";
    std::string output;
    double seconds = 0;
    unsigned short port = 0;
};

/// What waits a little.
constexpr std::chrono::milliseconds moment{50};

bool is_picture(const std::string& file) {
    return std::filesystem::path(file).extension() == ".exr";
}

void announce(const LocalServer& server, const Streams& streams) {
    streams.out << server.url() << '\n' << std::flush;
}

/// Shows finished pictures until a signal comes.
void view_pictures(const ViewOptions& options, const Streams& streams) {
    Board board;
    for (const std::string& file : options.files) {
        ShownPicture shown;
        shown.name = std::filesystem::path(file).filename().string();
        shown.phase = "file";
        shown.picture = std::make_shared<const Picture>(read_picture(file));
        shown.size = {shown.picture->image.width, shown.picture->image.height};
        shown.offset = shown.picture->offset;
        shown.layers = layer_names(*shown.picture);
        shown.version = 1;
        board.show(board.pictures().size(), std::move(shown));
    }
    const ViewOffer offer{board.picture(0).name, nullptr, {}};
    const InterruptGuard interrupt;
    const LocalServer server(options.port, view_page,
                             [&](std::string_view message) { return answer(board, offer, message); });
    announce(server, streams);
    while (!interrupt.is_requested()) {
        std::this_thread::sleep_for(moment);
    }
    throw EndedBySignal{interrupt.signal()};
}

/// Where a render's picture goes: several have their presets in their names.
std::filesystem::path output_of(const ViewOptions& options, const Session& session, const LiveRenders& renders,
                                std::size_t index) {
    std::filesystem::path name = options.output.empty()
                                     ? std::filesystem::path(session.scene_file()).stem().replace_extension(".exr")
                                     : std::filesystem::path(options.output);
    if (renders.size() > 1) {
        const std::string extension = name.extension().string();
        name.replace_extension();
        name += "-" + renders.sampling(index) + extension;
    }
    return name;
}

void view_scene(const ViewOptions& options, const Streams& streams) {
    using Kind = ViewCommand::Kind;
    const std::vector<std::string> samplings = split_list(options.sampling);
    for (const std::string& sampling : samplings) {
        parse_preset(sampling);
    }
    if (!options.output.empty()) {
        require_writable_picture(options.output);
    }
    const Session session(options.scene, options.common, streams);
    Board board;
    const InterruptGuard interrupt;
    LiveRenders renders(session, board, samplings, options.seconds, interrupt.flag());
    ViewOffer offer{std::filesystem::path(session.scene_file()).filename().string(),
                    &session.scene(),
                    {Kind::pause, Kind::go_on, Kind::save, Kind::restart}};
    if (options.seconds > 0) {
        offer.can.push_back(Kind::more_seconds);
    }
    for (const Preset& preset : ablation_presets()) {
        offer.samplings.push_back(to_string(preset));
    }
    const LocalServer server(options.port, view_page,
                             [&](std::string_view message) { return answer(board, offer, message); });
    announce(server, streams);
    const auto save = [&](std::size_t index) {
        const std::filesystem::path file = output_of(options, session, renders, index);
        try {
            write_picture(file, renders.picture(index));
            board.say("written: " + file.string());
        } catch (const std::exception& error) {
            board.say(error.what());
        }
        options.common.note(streams, board.note());
    };
    while (!interrupt.is_requested()) {
        for (const ViewCommand& command : board.take()) {
            renders.obey(command, save);
        }
        if (renders.is_busy()) {
            renders.step();
        } else {
            std::this_thread::sleep_for(moment);
        }
    }
    for (std::size_t i = 0; i < renders.size() && !options.output.empty(); ++i) {
        save(i);
    }
    throw EndedBySignal{interrupt.signal()};
}

void view(ViewOptions options, const Streams& streams) {
    if (std::all_of(options.files.begin(), options.files.end(), is_picture)) {
        view_pictures(options, streams);
    } else if (options.files.size() == 1) {
        options.scene.file = options.files[0];
        view_scene(options, streams);
    } else {
        throw InputError("one scene, or pictures alone (.exr)");
    }
}

}  // namespace

Action add_view_command(CLI::App& program) {
    const auto options = std::make_shared<ViewOptions>();
    CLI::App& command = *program.add_subcommand(
        "view", "render a scene and watch it in a browser of this machine, or look at finished pictures");
    command.add_option("files", options->files, "a scene file (pbrt-v4, or Mitsuba 3's .xml), or pictures (.exr)")
        ->required();
    command
        .add_option("--sampling", options->sampling,
                    "as that of 'wend render'; several, joined by commas, are rendered side by side in equal time")
        ->capture_default_str();
    command
        .add_option("--time", options->seconds,
                    "seconds that each render has before it waits to be given more (default: no end)")
        ->check(seconds_problem);
    command.add_option(
        "-o,--output", options->output,
        "where 'Save now' writes the picture, and the end of the program, too (default: the scene's name "
        "in the current folder, and only when asked)");
    command.add_option("--port", options->port, "of the server, on 127.0.0.1 (default: one that is free)")
        ->check(port_problem);
    options->scene.add_choices_to(command);
    options->common.add_to(command);
    return [options](const Streams& streams) { view(*options, streams); };
}

}  // namespace wend
