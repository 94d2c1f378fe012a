#pragma once

#include <wend/core/error.h>

#include <cstdint>
#include <cstring>
#include <string_view>

namespace wend {

/// Takes the content of a binary file apart from its front; numbers are in this machine's byte order.
/// Whatever would go beyond the end throws InputError.
class Bytes {
public:
    Bytes(std::string_view bytes, Place place) : all_(bytes), place_(std::move(place)) {}

    std::string_view take(std::uint64_t count) {
        if (count > all_.size() - at_) {
            throw InputError(place_, "the file is truncated");
        }
        const std::string_view taken = all_.substr(at_, count);
        at_ += count;
        return taken;
    }
    template <class T>
    T take() {
        T value;
        std::memcpy(static_cast<void*>(&value), take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    /// Goes to a place counted from the beginning.
    void seek(std::uint64_t place) {
        at_ = 0;
        take(place);
    }
    bool empty() const { return at_ == all_.size(); }
    std::size_t left() const { return all_.size() - at_; }

private:
    std::string_view all_;
    std::size_t at_ = 0;
    Place place_;
};

}  // namespace wend
