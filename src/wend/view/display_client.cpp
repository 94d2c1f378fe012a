#include <wend/view/display_client.h>

#include <wend/core/error.h>

#include <fmt/format.h>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

namespace wend {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

const std::vector<std::string> colours = {"R", "G", "B"};

/// A packet in the making. Numbers are little-endian.
class Packet {
public:
    enum class Kind : std::uint8_t { create = 4, update = 6 };

    explicit Packet(Kind kind) {
        add(std::uint32_t{0});
        add(static_cast<std::uint8_t>(kind));
        // The viewer need not come to the front.
        add(std::uint8_t{0});
    }

    template <class Number>
    void add(Number number) {
        static_assert(std::endian::native == std::endian::little);
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof(number));
    }
    void add_text(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
    void add_texts(const std::vector<std::string>& texts) {
        add(static_cast<std::int32_t>(texts.size()));
        for (const std::string& text : texts) {
            add_text(text);
        }
    }
    void add_values(std::span<const float> values) {
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }

    /// With its length in front.
    std::string take() {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof(length));
        return std::move(bytes_);
    }

private:
    std::string bytes_;
};

}  // namespace

std::string create_picture_packet(const std::string& name, const Vec2i& size,
                                  const std::vector<std::string>& channels) {
    Packet packet(Packet::Kind::create);
    packet.add_text(name);
    packet.add(static_cast<std::int32_t>(size.x));
    packet.add(static_cast<std::int32_t>(size.y));
    packet.add_texts(channels);
    return packet.take();
}

std::string update_picture_packet(const std::string& name, const std::vector<std::string>& channels,
                                  const PixelRect& rectangle, std::span<const float> values) {
    Packet packet(Packet::Kind::update);
    packet.add_text(name);
    packet.add_texts(channels);
    for (const int number : {rectangle.min.x, rectangle.min.y, rectangle.width(), rectangle.height()}) {
        packet.add(static_cast<std::int32_t>(number));
    }
    // Where the first value of each channel is, and how far apart its values are.
    for (std::size_t c = 0; c < channels.size(); ++c) {
        packet.add(static_cast<std::int64_t>(c));
    }
    for (std::size_t c = 0; c < channels.size(); ++c) {
        packet.add(static_cast<std::int64_t>(channels.size()));
    }
    packet.add_values(values);
    return packet.take();
}

class DisplayClient::Sending {
public:
    Sending(const std::string& server, Board& board, std::size_t index)
        : board_(board), index_(index), socket_(context_) {
        const std::size_t colon = server.rfind(':');
        if (colon == std::string::npos || colon == 0 || colon + 1 == server.size()) {
            throw InputError("display server '" + server + "': expected HOST:PORT, such as localhost:14158");
        }
        boost::system::error_code error;
        Tcp::resolver resolver(context_);
        const auto places = resolver.resolve(server.substr(0, colon), server.substr(colon + 1), error);
        if (!error) {
            asio::connect(socket_, places, error);
        }
        if (error) {
            throw InputError("display server " + server + ": " + error.message());
        }
        thread_ = std::thread([this] { run(); });
    }
    ~Sending() {
        {
            const std::lock_guard lock(mutex_);
            is_over_ = true;
        }
        over_.notify_all();
        // A peer that takes nothing is not waited for.
        constexpr std::chrono::seconds patience{2};
        std::unique_lock lock(mutex_);
        if (!over_.wait_for(lock, patience, [this] { return has_ended_; })) {
            ::shutdown(socket_.native_handle(), SHUT_RDWR);
        }
        lock.unlock();
        thread_.join();
    }

private:
    void run() {
        constexpr std::chrono::milliseconds moment{250};
        bool is_over = false, is_open = true;
        while (!is_over && is_open) {
            std::unique_lock lock(mutex_);
            is_over = over_.wait_for(lock, moment, [this] { return is_over_; });
            lock.unlock();
            is_open = send_if_new();
        }
        {
            const std::lock_guard lock(mutex_);
            has_ended_ = true;
        }
        over_.notify_all();
    }

    /// False once the peer has gone.
    bool send_if_new() {
        board_.want(index_, version_, false);
        const ShownPicture shown = board_.picture(index_);
        if (!shown.picture || shown.version <= version_) {
            return true;
        }
        const Image& image = shown.picture->image;
        bool is_open = version_ > 0 || send(create_picture_packet(shown.name, {image.width, image.height}, colours));
        version_ = shown.version;
        constexpr int side = 128;
        for (int y = 0; y < image.height; y += side) {
            for (int x = 0; x < image.width && is_open; x += side) {
                is_open = send_tile(shown.name, image,
                                    {{x, y}, {std::min(x + side, image.width), std::min(y + side, image.height)}});
            }
        }
        return is_open;
    }

    bool send_tile(const std::string& name, const Image& image, const PixelRect& tile) {
        std::vector<float> values;
        for (int y = tile.min.y; y < tile.max.y; ++y) {
            for (int x = tile.min.x; x < tile.max.x; ++x) {
                const Rgb& pixel = image.at(x, y);
                values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
            }
        }
        return send(update_picture_packet(name, colours, tile, values));
    }

    bool send(const std::string& bytes) {
        boost::system::error_code error;
        asio::write(socket_, asio::buffer(bytes), error);
        return !error;
    }

    Board& board_;
    std::size_t index_;
    std::uint64_t version_ = 0;  ///< that was sent
    asio::io_context context_;
    Tcp::socket socket_;
    std::mutex mutex_;
    std::condition_variable over_;
    bool is_over_ = false, has_ended_ = false;
    std::thread thread_;
};

DisplayClient::DisplayClient(const std::string& server, Board& board, std::size_t index)
    : sending_(std::make_unique<Sending>(server, board, index)) {
}

DisplayClient::~DisplayClient() = default;

}  // namespace wend
