#include <wend/view/board.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wend {

std::vector<std::string> layer_names(const Picture& picture) {
    std::vector<std::string> names;
    for (const Layer& layer : picture.layers) {
        names.push_back(layer.name);
    }
    return names;
}

void Board::show(std::size_t index, ShownPicture shown) {
    const std::lock_guard lock(mutex_);
    if (index >= pictures_.size()) {
        pictures_.resize(index + 1);
        wanted_.resize(index + 1);
    }
    Wanted& wanted = wanted_[index];
    if (shown.version != pictures_[index].version && wanted.versions_with_layers > 0) {
        --wanted.versions_with_layers;
    }
    pictures_[index] = std::move(shown);
}

std::vector<ShownPicture> Board::pictures() const {
    const std::lock_guard lock(mutex_);
    return pictures_;
}

ShownPicture Board::picture(std::size_t index) const {
    const std::lock_guard lock(mutex_);
    if (index >= pictures_.size()) {
        throw InputError(fmt::format("there is no picture {}", index));
    }
    return pictures_[index];
}

void Board::want(std::size_t index, std::uint64_t version, bool layers) {
    constexpr int patience = 3;
    const std::lock_guard lock(mutex_);
    if (index < wanted_.size()) {
        Wanted& wanted = wanted_[index];
        wanted = {true, layers ? patience : wanted.versions_with_layers, std::max(wanted.beyond, version)};
    }
}

bool Board::is_wanted(std::size_t index, std::uint64_t version) const {
    const std::lock_guard lock(mutex_);
    return index < wanted_.size() && wanted_[index].any && wanted_[index].beyond >= version;
}

bool Board::wants_layers(std::size_t index) const {
    const std::lock_guard lock(mutex_);
    return index < wanted_.size() && wanted_[index].versions_with_layers > 0;
}

void Board::post(ViewCommand command) {
    constexpr std::size_t most = 64;
    const std::lock_guard lock(mutex_);
    if (commands_.size() < most) {
        commands_.push_back(std::move(command));
    }
}

std::vector<ViewCommand> Board::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
}

void Board::say(std::string note) {
    const std::lock_guard lock(mutex_);
    note_ = std::move(note);
}

std::string Board::note() const {
    const std::lock_guard lock(mutex_);
    return note_;
}

}  // namespace wend
