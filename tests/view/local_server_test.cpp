// Whom the server answers, and whom it does not.
#include <wend/core/error.h>
#include <wend/view/local_server.h>

#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace wend {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;
using Socket = beast::websocket::stream<Tcp::socket>;

constexpr ServedFile files[] = {{"", "text/html", "<p>page</p>"}, {"code.js", "text/javascript", "run();"}};

Reply echo(std::string_view message) {
    return {"heard " + std::string(message), false};
}

/// The parts of "http://127.0.0.1:PORT/TOKEN/".
struct Address {
    explicit Address(const std::string& url) {
        const std::size_t port_at = url.rfind(':') + 1, path_at = url.find('/', port_at);
        port = static_cast<unsigned short>(std::stoi(url.substr(port_at, path_at - port_at)));
        path = url.substr(path_at);
        host = "127.0.0.1:" + std::to_string(port);
    }

    unsigned short port;
    std::string path, host;
};

class Client {
public:
    explicit Client(const Address& address) : address_(address), socket_(context_) {
        socket_.connect({asio::ip::address_v4::loopback(), address.port});
    }

    http::response<http::string_body> get(const std::string& path, const std::string& host = {},
                                          const std::string& origin = {}, http::verb verb = http::verb::get) {
        http::request<http::string_body> request(verb, path, 11);
        request.set(http::field::host, host.empty() ? address_.host : host);
        if (!origin.empty()) {
            request.set(http::field::origin, origin);
        }
        http::write(socket_, request);
        http::response<http::string_body> response;
        http::read(socket_, buffer_, response);
        return response;
    }

    Tcp::socket take() { return std::move(socket_); }

private:
    Address address_;
    asio::io_context context_;
    Tcp::socket socket_;
    beast::flat_buffer buffer_;
};

/// A WebSocket that is open, or the error that it met.
class Speaker {
public:
    explicit Speaker(const Address& address, const std::string& origin = {}, const std::string& token_path = {})
        : socket_(context_) {
        socket_.next_layer().connect({asio::ip::address_v4::loopback(), address.port});
        socket_.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
            if (!origin.empty()) {
                request.set(http::field::origin, origin);
            }
        }));
        socket_.handshake(address.host, (token_path.empty() ? address.path : token_path) + "socket", error);
    }

    std::string ask(const std::string& message) {
        socket_.write(asio::buffer(message), error);
        beast::flat_buffer buffer;
        if (!error) {
            socket_.read(buffer, error);
        }
        return beast::buffers_to_string(buffer.data());
    }
    void write(const std::string& message) { socket_.write(asio::buffer(message), error); }

    beast::error_code error;

private:
    asio::io_context context_;
    Socket socket_;
};

TEST(LocalServer, HasFilesForWhoKnowsTheToken) {
    const LocalServer server(0, files, echo);
    const Address address(server.url());
    Client client(address);
    EXPECT_EQ(client.get(address.path).body(), "<p>page</p>");
    const auto code = client.get(address.path + "code.js");
    EXPECT_EQ(code.body(), "run();");
    EXPECT_EQ(code[http::field::content_type], "text/javascript");
    EXPECT_NE(code["Content-Security-Policy"].find("default-src 'none'"), beast::string_view::npos);
    EXPECT_EQ(client.get(address.path + "other.js").result(), http::status::not_found);
    EXPECT_EQ(client.get(address.path, {}, {}, http::verb::post).result(), http::status::method_not_allowed);
}

TEST(LocalServer, RefusesWrongTokensNamesAndOrigins) {
    const LocalServer server(0, files, echo);
    const Address address(server.url());
    std::string wrong = address.path;
    wrong[1] = wrong[1] == '0' ? '1' : '0';
    for (const std::string& path :
         {std::string("/"), std::string("/code.js"), wrong, address.path.substr(0, 9) + "/"}) {
        EXPECT_EQ(Client(address).get(path).result(), http::status::forbidden) << path;
    }
    EXPECT_EQ(Client(address).get(address.path, "evil.example").result(), http::status::forbidden)
        << "a name that was made to lead here";
    EXPECT_EQ(Client(address).get(address.path, {}, "http://evil.example").result(), http::status::forbidden);
    EXPECT_EQ(Client(address).get(address.path, {}, "http://127.0.0.1:1").result(), http::status::forbidden)
        << "another server of this machine";
    EXPECT_EQ(Client(address).get(address.path, {}, "http://" + address.host).result(), http::status::ok);
    EXPECT_NE(LocalServer(0, files, echo).url(), LocalServer(0, files, echo).url());
}

TEST(LocalServer, TalksToViewersOfItsOwnPageAlone) {
    const LocalServer server(0, files, echo);
    const Address address(server.url());
    Speaker one(address), two(address, "http://" + address.host);
    EXPECT_EQ(one.ask("a"), "heard a");
    EXPECT_EQ(two.ask("b"), "heard b");
    EXPECT_EQ(one.ask("c"), "heard c");
    EXPECT_TRUE(Speaker(address, "http://evil.example").error);
    EXPECT_TRUE(Speaker(address, {}, "/0123456789abcdef0123456789abcdef/").error);
}

TEST(LocalServer, CutsOffFloodsAndLongMessages) {
    std::atomic<int> answered = 0;
    LocalServer::Limits limits;
    limits.questions_a_second = 50;
    const auto count = [&](std::string_view message) {
        ++answered;
        return echo(message);
    };
    const LocalServer server(0, files, count, limits);
    const Address address(server.url());
    Speaker flood(address);
    for (int i = 0; i < 10000 && !flood.error; ++i) {
        flood.ask("again");
    }
    EXPECT_TRUE(flood.error);
    // A second may have begun in the middle.
    EXPECT_LE(answered, 10000 / 2);
    Speaker talker(address);
    talker.ask(std::string(limits.message + 1, 'x'));
    EXPECT_TRUE(talker.error);
    EXPECT_EQ(Speaker(address).ask("still there"), "heard still there");
}

TEST(LocalServer, ASlowReaderIsAloneWithIt) {
    std::atomic<int> large = 0;
    const auto answer = [&](std::string_view message) {
        large += message == "large" ? 1 : 0;
        return message == "large" ? Reply{std::string(std::size_t{64} << 20, 'x'), true} : echo(message);
    };
    const LocalServer server(0, files, answer);
    const Address address(server.url());
    Speaker slow(address);
    for (int i = 0; i < 8; ++i) {
        slow.write("large");
    }
    Speaker other(address);
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(other.ask("quick"), "heard quick");
    }
    EXPECT_LE(large, 1) << "the next question is read when the answer before has gone";
}

TEST(LocalServer, HasSoManyConnectionsAndNoMore) {
    LocalServer::Limits limits;
    limits.connections = 3;
    const LocalServer server(0, files, echo, limits);
    const Address address(server.url());
    std::vector<std::unique_ptr<Speaker>> speakers;
    for (int i = 0; i < 3; ++i) {
        speakers.push_back(std::make_unique<Speaker>(address));
        EXPECT_EQ(speakers.back()->ask("here"), "heard here");
    }
    EXPECT_TRUE(Speaker(address).error);
    EXPECT_EQ(speakers[0]->ask("still"), "heard still");
}

TEST(LocalServer, SaysThatAPortIsTaken) {
    const LocalServer server(0, files, echo);
    const unsigned short port = Address(server.url()).port;
    try {
        const LocalServer other(port, files, echo);
        FAIL() << "two servers listen on one port";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(port)), std::string::npos);
    }
}

}  // namespace
}  // namespace wend
