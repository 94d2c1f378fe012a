#include <wend/view/local_server.h>

#include <wend/core/error.h>

#include <fmt/format.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace wend {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Error = beast::error_code;
using Request = http::request<http::string_body>;

/// 128 bits that nobody can guess.
std::string new_token() {
    std::random_device device;
    std::string token;
    for (int i = 0; i < 4; ++i) {
        token += fmt::format("{:08x}", device());
    }
    return token;
}

/// As long for every text of that length: how much of a token was right does not show.
bool is_same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) {
        return false;
    }
    unsigned char differs = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        differs = static_cast<unsigned char>(differs | (a[i] ^ b[i]));
    }
    return differs == 0;
}

/// Whether a request names this machine by its own name: any other leads a browser here by a trick.
bool names_this_machine(std::string_view host) {
    const std::string_view name = host.substr(0, host.rfind(':'));
    return name == "127.0.0.1" || name == "localhost";
}

std::string_view text_of(beast::string_view text) {
    return {text.data(), text.size()};
}

/// What all connections share.
struct Shared {
    std::string token;
    std::vector<ServedFile> files;
    LocalServer::Answer answer;
    LocalServer::Limits limits;
    int connections = 0;  ///< of the server's thread alone
};

/// Counts one connection while it lives.
class Counted {
public:
    explicit Counted(Shared& shared) : shared_(shared) { ++shared_.connections; }
    ~Counted() { --shared_.connections; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

private:
    Shared& shared_;
};

/// A WebSocket: it reads a question, and not the next one before that is answered.
class Conversation : public std::enable_shared_from_this<Conversation> {
public:
    Conversation(Shared& shared, beast::tcp_stream stream)
        : shared_(shared), counted_(shared), socket_(std::move(stream)) {}

    void begin(const Request& request) {
        websocket::stream_base::timeout timeout{};
        timeout.handshake_timeout = std::chrono::seconds(5);
        timeout.idle_timeout = std::chrono::seconds(shared_.limits.seconds_to_wait);
        timeout.keep_alive_pings = true;
        socket_.set_option(timeout);
        socket_.read_message_max(shared_.limits.message);
        request_ = request;
        socket_.async_accept(request_, [self = shared_from_this()](Error error) {
            if (!error) {
                self->read();
            }
        });
    }

private:
    void read() {
        question_.clear();
        socket_.async_read(question_, [self = shared_from_this()](Error error, std::size_t) {
            if (!error) {
                self->answer();
            }
        });
    }

    /// Whether it asks more than anyone needs to.
    bool is_flood() {
        const auto now = std::chrono::steady_clock::now();
        if (now - second_ > std::chrono::seconds(1)) {
            second_ = now;
            questions_ = 0;
        }
        return ++questions_ > shared_.limits.questions_a_second;
    }

    void answer() {
        if (is_flood()) {
            socket_.async_close({websocket::close_code::policy_error, "too many questions"},
                                [self = shared_from_this()](Error) {});
            return;
        }
        const auto bytes = question_.data();
        reply_ = shared_.answer({static_cast<const char*>(bytes.data()), bytes.size()});
        socket_.binary(reply_.is_binary);
        socket_.async_write(asio::buffer(reply_.bytes), [self = shared_from_this()](Error error, std::size_t) {
            if (!error) {
                self->read();
            }
        });
    }

    Shared& shared_;
    Counted counted_;
    websocket::stream<beast::tcp_stream> socket_;
    Request request_;
    beast::flat_buffer question_;
    Reply reply_;
    std::chrono::steady_clock::time_point second_;
    int questions_ = 0;
};

/// A connection that asks for files, until it becomes a WebSocket.
class Visit : public std::enable_shared_from_this<Visit> {
public:
    Visit(Shared& shared, Tcp::socket socket) : shared_(shared), counted_(shared), stream_(std::move(socket)) {}

    void read() {
        constexpr std::uint32_t most_header = 8192;
        parser_.emplace();
        parser_->header_limit(most_header);
        parser_->body_limit(0);
        stream_.expires_after(std::chrono::seconds(shared_.limits.seconds_to_wait));
        http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
            if (!error) {
                self->answer();
            }
        });
    }

private:
    void answer() {
        const Request& request = parser_->get();
        const auto [status, file] = find(request);
        if (status == http::status::switching_protocols) {
            stream_.expires_never();
            std::make_shared<Conversation>(shared_, std::move(stream_))->begin(request);
            return;
        }
        response_ = http::response<http::string_body>(status, request.version());
        response_.set(http::field::content_type, std::string(file ? file->type : "text/plain; charset=utf-8"));
        response_.set(http::field::cache_control, "no-store");
        response_.set("Content-Security-Policy",
                      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
                      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
        response_.set("X-Content-Type-Options", "nosniff");
        response_.set("Referrer-Policy", "no-referrer");
        response_.set("Cross-Origin-Resource-Policy", "same-origin");
        response_.keep_alive(request.keep_alive());
        const std::string_view text = file ? file->text : std::string_view(text_of(http::obsolete_reason(status)));
        response_.body() = request.method() == http::verb::head ? std::string() : std::string(text);
        response_.content_length(text.size());
        http::async_write(stream_, response_, [self = shared_from_this()](Error error, std::size_t) {
            if (!error && self->response_.keep_alive()) {
                self->read();
            }
        });
    }

    /// What a request is answered, and by which file.
    std::pair<http::status, const ServedFile*> find(const Request& request) const {
        const std::string_view host = text_of(request[http::field::host]);
        const std::string_view origin = text_of(request[http::field::origin]);
        if (!names_this_machine(host) || (!origin.empty() && origin != "http://" + std::string(host))) {
            return {http::status::forbidden, nullptr};
        }
        const std::string_view path = text_of(request.target());
        const std::size_t end = std::min(path.find('/', 1), path.size());
        if (path.empty() || !is_same(path.substr(1, end - 1), shared_.token)) {
            return {http::status::forbidden, nullptr};
        }
        const std::string_view name = end < path.size() ? path.substr(end + 1) : "?";
        if (name == "socket" && websocket::is_upgrade(request)) {
            return {http::status::switching_protocols, nullptr};
        }
        if (request.method() != http::verb::get && request.method() != http::verb::head) {
            return {http::status::method_not_allowed, nullptr};
        }
        const auto file = std::find_if(shared_.files.begin(), shared_.files.end(),
                                       [&](const ServedFile& served) { return served.name == name; });
        return file != shared_.files.end() ? std::pair(http::status::ok, &*file)
                                           : std::pair(http::status::not_found, nullptr);
    }

    Shared& shared_;
    Counted counted_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::string_body>> parser_;
    http::response<http::string_body> response_;
};

}  // namespace

class LocalServer::Listening {
public:
    Listening(unsigned short port, std::span<const ServedFile> files, Answer answer, const Limits& limits)
        : shared_{new_token(), {files.begin(), files.end()}, std::move(answer), limits},
          acceptor_(context_),
          pause_(context_) {
        const Tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
        Error error;
        acceptor_.open(endpoint.protocol());
        acceptor_.set_option(asio::socket_base::reuse_address(true));
        acceptor_.bind(endpoint, error);
        if (!error) {
            acceptor_.listen(asio::socket_base::max_listen_connections, error);
        }
        if (error) {
            throw InputError(fmt::format("port {}: {}", port, error.message()));
        }
        accept();
        thread_ = std::thread([this] { context_.run(); });
    }
    ~Listening() {
        context_.stop();
        thread_.join();
    }

    std::string url() const {
        return fmt::format("http://127.0.0.1:{}/{}/", acceptor_.local_endpoint().port(), shared_.token);
    }

private:
    void accept() {
        acceptor_.async_accept([this](Error error, Tcp::socket socket) {
            // Beyond the limit they are closed at once.
            if (!error && shared_.connections < shared_.limits.connections) {
                std::make_shared<Visit>(shared_, std::move(socket))->read();
            }
            if (!error) {
                accept();
            } else if (error != asio::error::operation_aborted) {
                // Such as that there are no more descriptors.
                pause_.expires_after(std::chrono::milliseconds(200));
                pause_.async_wait([this](Error) { accept(); });
            }
        });
    }

    Shared shared_;
    asio::io_context context_{1};
    Tcp::acceptor acceptor_;
    asio::steady_timer pause_;
    std::thread thread_;
};

LocalServer::LocalServer(unsigned short port, std::span<const ServedFile> files, Answer answer, const Limits& limits)
    : listening_(std::make_unique<Listening>(port, files, std::move(answer), limits)) {
}

LocalServer::LocalServer(unsigned short port, std::span<const ServedFile> files, Answer answer)
    : LocalServer(port, files, std::move(answer), Limits()) {
}

LocalServer::~LocalServer() = default;

std::string LocalServer::url() const {
    return listening_->url();
}

}  // namespace wend
