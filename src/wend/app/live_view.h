// The live view of one render: `wend render --live`.
#pragma once

#include <wend/app/session.h>
#include <wend/view/render_view.h>

#include <functional>
#include <memory>

namespace wend {

class LocalServer;

/// Shows a render to viewers while it runs, and does what they ask for: to save the picture, or to end.
class LiveView {
public:
    /// Serves at once, and says where. The session must outlive it. Throws InputError where the port is taken.
    LiveView(unsigned short port, const Session& session, const Preset& preset, const Streams& streams);
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
};

}  // namespace wend
