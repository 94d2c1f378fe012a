// A server for browsers on this machine: a few files, and a WebSocket that answers requests.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace wend {

/// A file as the server has it.
struct ServedFile {
    std::string_view name;  ///< behind the token; "" is the page itself
    std::string_view type;  ///< of its media
    std::string_view text;
};

/// What a WebSocket is answered.
struct Reply {
    std::string bytes;
    bool is_binary = false;  ///< bytes rather than text
};

/// Listens on the loopback address, in a thread of its own, as long as it lives. Whoever has no token in the address is
/// refused, and so are pages of other origins and names of this machine that are none. A connection has one question
/// under way at a time: a reader that is slow waits for itself alone, and one that asks without end is cut off.
class LocalServer {
public:
    /// Answers a message of a WebSocket; called by the server's thread.
    using Answer = std::function<Reply(std::string_view message)>;

    struct Limits {
        int connections = 32;           ///< open at a time
        int questions_a_second = 200;   ///< of one connection
        int seconds_to_wait = 30;       ///< for a peer that neither reads nor writes
        std::size_t message = 1 << 14;  ///< bytes of a question
    };

    /// `port` 0: one that is free. The files' texts must outlive it. Throws InputError where the port is taken.
    LocalServer(unsigned short port, std::span<const ServedFile> files, Answer answer, const Limits& limits);
    LocalServer(unsigned short port, std::span<const ServedFile> files, Answer answer);
    ~LocalServer();
    LocalServer(const LocalServer&) = delete;
    LocalServer& operator=(const LocalServer&) = delete;

    /// Of the page, with the token.
    std::string url() const;

private:
    class Listening;
    std::unique_ptr<Listening> listening_;
};

}  // namespace wend
