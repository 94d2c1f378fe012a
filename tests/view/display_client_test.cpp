// Packets of tev's protocol, read by a decoder of its own.
#include <wend/core/error.h>
#include <wend/view/display_client.h>

#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>

#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <thread>

namespace wend {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

/// What a viewer has of a picture.
struct Shown {
    std::string name;
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels;
};

/// Reads packets as tev's description has them.
class Decoder {
public:
    explicit Decoder(const std::string& bytes) : bytes_(bytes) {}

    template <class Number>
    Number number() {
        Number number;
        std::memcpy(&number, bytes_.data() + at_, sizeof(number));
        at_ += sizeof(number);
        return number;
    }
    std::string text() {
        const std::string text = bytes_.c_str() + at_;
        at_ += text.size() + 1;
        return text;
    }
    bool is_at_end() const { return at_ == bytes_.size(); }

    void apply(Shown& shown) {
        EXPECT_EQ(number<std::uint32_t>(), bytes_.size());
        const int kind = number<std::uint8_t>();
        number<std::uint8_t>();
        const std::string name = text();
        if (kind == 4) {
            shown.name = name;
            shown.width = number<std::int32_t>();
            shown.height = number<std::int32_t>();
            for (int count = number<std::int32_t>(); count > 0; --count) {
                shown.channels[text()].assign(static_cast<std::size_t>(shown.width * shown.height), -1.0f);
            }
        } else {
            ASSERT_EQ(kind, 6);
            EXPECT_EQ(name, shown.name);
            update(shown);
        }
        EXPECT_TRUE(is_at_end());
    }

private:
    void update(Shown& shown) {
        std::vector<std::string> names(static_cast<std::size_t>(number<std::int32_t>()));
        for (std::string& name : names) {
            name = text();
        }
        const int x = number<std::int32_t>(), y = number<std::int32_t>();
        const int width = number<std::int32_t>(), height = number<std::int32_t>();
        std::vector<std::int64_t> offsets, strides;
        for (std::size_t c = 0; c < names.size(); ++c) {
            offsets.push_back(number<std::int64_t>());
        }
        for (std::size_t c = 0; c < names.size(); ++c) {
            strides.push_back(number<std::int64_t>());
        }
        std::vector<float> values(names.size() * static_cast<std::size_t>(width * height));
        for (float& value : values) {
            value = number<float>();
        }
        for (std::size_t c = 0; c < names.size(); ++c) {
            for (int i = 0; i < width * height; ++i) {
                shown.channels[names[c]][static_cast<std::size_t>((y + i / width) * shown.width + x + i % width)] =
                    values[static_cast<std::size_t>(offsets[c] + i * strides[c])];
            }
        }
    }

    std::string bytes_;
    std::size_t at_ = 0;
};

/// A viewer that takes whatever one client sends until that ends.
class Viewer {
public:
    Viewer() : acceptor_(context_, {asio::ip::address_v4::loopback(), 0}), thread_([this] { run(); }) {}
    std::string address() const { return "127.0.0.1:" + std::to_string(acceptor_.local_endpoint().port()); }
    const Shown& wait() {
        thread_.join();
        return shown_;
    }

private:
    void run() {
        Tcp::socket socket = acceptor_.accept();
        for (boost::system::error_code error; !error;) {
            std::string bytes(4, '\0');
            asio::read(socket, asio::buffer(bytes), error);
            if (!error) {
                std::uint32_t length = 0;
                std::memcpy(&length, bytes.data(), sizeof(length));
                bytes.resize(length);
                asio::read(socket, asio::buffer(bytes.data() + 4, length - 4), error);
                Decoder(bytes).apply(shown_);
            }
        }
    }

    asio::io_context context_;
    Tcp::acceptor acceptor_;
    Shown shown_;
    std::thread thread_;
};

ShownPicture picture_of(int width, int height, float scale) {
    Picture picture;
    picture.image = Image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.image.at(x, y) = Rgb(scale * static_cast<float>(x), scale * static_cast<float>(y), scale);
        }
    }
    ShownPicture shown;
    shown.name = "scene";
    shown.picture = std::make_shared<const Picture>(std::move(picture));
    shown.version = static_cast<std::uint64_t>(scale);
    return shown;
}

TEST(DisplayClient, TheLastPictureArrivesWhole) {
    Viewer viewer;
    Board board;
    board.show(0, picture_of(300, 140, 1));
    {
        const DisplayClient client(viewer.address(), board, 0);
        board.show(0, picture_of(300, 140, 2));
    }
    const Shown& shown = viewer.wait();
    EXPECT_EQ(shown.name, "scene");
    ASSERT_EQ(shown.width, 300);
    ASSERT_EQ(shown.height, 140);
    for (const auto& [x, y] : {std::array{0, 0}, std::array{299, 0}, std::array{0, 139}, std::array{128, 127}}) {
        const auto i = static_cast<std::size_t>(y * 300 + x);
        EXPECT_EQ(shown.channels.at("R")[i], 2.0f * static_cast<float>(x));
        EXPECT_EQ(shown.channels.at("G")[i], 2.0f * static_cast<float>(y));
        EXPECT_EQ(shown.channels.at("B")[i], 2.0f);
    }
}

TEST(DisplayClient, SaysThatNobodyListens) {
    Board board;
    board.show(0, picture_of(1, 1, 1));
    for (const std::string& server : {std::string("127.0.0.1:1"), std::string("nowhere"), std::string(":14158"),
                                      std::string("localhost:"), std::string("localhost:port")}) {
        EXPECT_THROW(DisplayClient(server, board, 0), InputError) << server;
    }
}

TEST(DisplayClient, APeerThatReadsNothingIsNotWaitedFor) {
    asio::io_context context;
    Tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
    Board board;
    board.show(0, picture_of(4000, 2000, 1));
    auto client =
        std::make_unique<DisplayClient>("127.0.0.1:" + std::to_string(acceptor.local_endpoint().port()), board, 0);
    const Tcp::socket socket = acceptor.accept();
    client.reset();
    EXPECT_TRUE(socket.is_open());
}

}  // namespace
}  // namespace wend
