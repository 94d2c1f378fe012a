// Sends a picture to a viewer that speaks tev's protocol, while it is rendered.
#pragma once

#include <wend/view/board.h>

#include <memory>
#include <string>

namespace wend {

/// The bytes of tev's packets (its README and its client in Python have the layout).
/// A new picture without anything in it; one of the same name is replaced.
std::string create_picture_packet(const std::string& name, const Vec2i& size, const std::vector<std::string>& channels);
/// A rectangle of its pixels: `values` row by row, all channels of a pixel together.
std::string update_picture_packet(const std::string& name, const std::vector<std::string>& channels,
                                  const PixelRect& rectangle, std::span<const float> values);

/// Watches a picture of a board, and sends it on whenever it is new, in a thread of its own.
class DisplayClient {
public:
    /// `server` is HOST:PORT. The board must outlive it. Throws InputError where nobody listens.
    DisplayClient(const std::string& server, Board& board, std::size_t index);
    /// Sends the last picture that there is, unless the peer takes none.
    ~DisplayClient();
    DisplayClient(const DisplayClient&) = delete;
    DisplayClient& operator=(const DisplayClient&) = delete;

private:
    class Sending;
    std::unique_ptr<Sending> sending_;
};

}  // namespace wend
