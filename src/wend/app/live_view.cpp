#include <wend/app/live_view.h>

#include <wend/core/error.h>
#include <wend/view/display_client.h>
#include <wend/view/page.h>
#include <wend/view/questions.h>

#include <CLI/CLI.hpp>

#include <csignal>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <ostream>
#include <thread>
#include <utility>

namespace wend {

std::string port_problem(const std::string& text) {
    unsigned port = 0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, port);
    const std::string problem = "'" + text + "' is no port, which is a number from 0 (any that is free) to 65535";
    if (read != end) {
        return problem;
    }
    // What cannot be the value of --live is taken for a scene, but this is none.
    if (error != std::errc() || port > 65535) {
        throw InputError(problem);
    }
    return "";
}

void LiveViewers::add_to(CLI::App& command) {
    command
        .add_option("--live", port,
                    "show the render in a browser of this machine while it runs; the port on 127.0.0.1 (default: one "
                    "that is free)")
        ->expected(0, 1)
        ->default_str("0")
        ->check(port_problem);
    command.add_option("--display-server", display_server,
                       "HOST:PORT of a viewer that speaks tev's protocol: send it the picture while it grows");
}

LiveView::LiveView(const LiveViewers& viewers, const Session& session, const Preset& preset, const Streams& streams)
    : view_(board_, 0, std::filesystem::path(session.scene_file()).stem().string() + " " + to_string(preset)) {
    if (!viewers.display_server.empty()) {
        display_ = std::make_unique<DisplayClient>(viewers.display_server, board_, 0);
    }
    if (!viewers.port) {
        return;
    }
    const ViewOffer offer{std::filesystem::path(session.scene_file()).filename().string(),
                          &session.scene(),
                          {ViewCommand::Kind::save, ViewCommand::Kind::stop}};
    server_ = std::make_unique<LocalServer>(
        *viewers.port, view_page, [this, offer](std::string_view message) { return answer(board_, offer, message); });
    streams.err << "view: " << server_->url() << '\n' << std::flush;
}

LiveView::~LiveView() = default;

RenderSettings LiveView::watched(RenderSettings settings) {
    if (!settings.preset.is_classical()) {
        settings.on_records = [this, others = settings.on_records](std::span<const guide::PathRecords> records) {
            view_.add(records);
            if (others) {
                others(records);
            }
        };
    }
    return settings;
}

void LiveView::update(const Render& render, const Film& film, const std::function<void()>& save) {
    for (const ViewCommand& command : board_.take()) {
        if (command.kind == ViewCommand::Kind::stop) {
            // As if it had been asked for at the keyboard.
            std::raise(SIGINT);
        } else {
            save();
            board_.say("written");
        }
    }
    const RenderProgress progress = render.progress();
    view_.update(render, film, progress, phase_of(progress));
}

void LiveView::finish(const Render& render, const Film& film) {
    constexpr std::chrono::milliseconds moment{50}, longest{1000};
    const std::uint64_t before = board_.picture(0).version;
    view_.update(render, film, render.progress(), "done");
    // Whoever has had a picture asks again soon, and tells thereby which one it has.
    const std::uint64_t last = board_.picture(0).version;
    for (auto waited = moment; waited < longest && board_.is_wanted(0, before) && !board_.is_wanted(0, last);
         waited += moment) {
        std::this_thread::sleep_for(moment);
    }
}

}  // namespace wend
