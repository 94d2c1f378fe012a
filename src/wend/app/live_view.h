// The live view of one render: `wend render --live` and `--display-server`.
#pragma once

#include <wend/app/session.h>
#include <wend/view/render_view.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace wend {

class DisplayClient;
class LocalServer;

/// What is wrong with a port of a server; empty: nothing. Throws InputError for a number that is too large.
std::string port_problem(const std::string& text);

/// Who watches.
struct LiveViewers {
    std::optional<unsigned short> port;  ///< of a server for browsers; 0: one that is free
    std::string display_server;          ///< HOST:PORT of a viewer such as tev; empty: none

    void add_to(CLI::App& command);
    bool any() const { return port || !display_server.empty(); }
};

/// Shows a render to viewers while it runs, and does what they ask for: to save the picture, or to end.
class LiveView {
public:
    /// Serves at once, and says where. The session must outlive it. Throws InputError where the port is taken, or no
    /// display server listens.
    LiveView(const LiveViewers& viewers, const Session& session, const Preset& preset, const Streams& streams);
    ~LiveView();

    /// The settings that the render is to have, so that viewers see what it learns from. This must outlive the render.
    RenderSettings watched(RenderSettings settings);
    /// Between steps. `save` writes the picture.
    void update(const Render& render, const Film& film, const std::function<void()>& save);
    /// At the end: waits a moment for viewers to see the last picture.
    void finish(const Render& render, const Film& film);

private:
    Board board_;
    RenderView view_;
    std::unique_ptr<LocalServer> server_;
    std::unique_ptr<DisplayClient> display_;
};

}  // namespace wend
