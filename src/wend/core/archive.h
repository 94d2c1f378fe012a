// Values as bytes and back, to keep a state or to send it.
#pragma once

#include <wend/core/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace wend {

/// A class that lists its members: `template <class Archive, class Self> static void archive(Archive&, Self&)` hands
/// them over, in the same order for both ways. What was read is checked there, by Archive::require().
template <class T, class Archive>
concept ListsMembers = requires(Archive& archive, T& value) {
    T::archive(archive, value);
};

/// Numbers and structures of numbers, taken as they lie in memory.
template <class T>
concept PlainValue = std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>;

/// Writes values one after another; numbers are in this machine's order.
class ArchiveWriter {
public:
    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    /// So many plain values, whose number the reader knows.
    template <PlainValue T>
    void raw(const T* values, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
    /// What the reader already has.
    template <PlainValue T>
    void same(const T& value) {
        put(value);
    }
    static void require(bool /*holds*/) {}

    const std::string& bytes() const { return bytes_; }
    std::string take() { return std::move(bytes_); }

private:
    template <class T>
    void put(const T& value) {
        if constexpr (ListsMembers<const T, ArchiveWriter>) {
            T::archive(*this, value);
        } else {
            static_assert(PlainValue<T>, "a class with members of its own lists them");
            raw(&value, 1);
        }
    }
    void put(const std::string& text) {
        put(static_cast<std::uint64_t>(text.size()));
        bytes_ += text;
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(static_cast<std::uint64_t>(values.size()));
        if constexpr (PlainValue<T> && !ListsMembers<const T, ArchiveWriter>) {
            raw(values.data(), values.size());
        } else {
            for (const T& value : values) {
                put(value);
            }
        }
    }
    template <class Key, class T>
    void put(const std::map<Key, T>& values) {
        put(static_cast<std::uint64_t>(values.size()));
        for (const auto& [key, value] : values) {
            put(key);
            put(value);
        }
    }
    template <class... T>
    void put(const std::tuple<T...>& values) {
        std::apply([this](const T&... each) { (put(each), ...); }, values);
    }

    std::string bytes_;
};

/// Takes the values again, in the same order. Whatever does not fit throws InputError; no more memory is asked for than
/// there are bytes.
class ArchiveReader {
public:
    /// The bytes must outlive it.
    explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}

    template <class... T>
    void operator()(T&... values) {
        (get(values), ...);
    }
    template <PlainValue T>
    void raw(T* values, std::size_t count) {
        require(count <= rest_.size() / sizeof(T));
        if (count > 0) {
            std::memcpy(static_cast<void*>(values), rest_.data(), count * sizeof(T));
            rest_.remove_prefix(count * sizeof(T));
        }
    }
    template <PlainValue T>
    void same(const T& value) {
        T found;
        raw(&found, 1);
        require(found == value);
    }
    static void require(bool holds) {
        if (!holds) {
            throw InputError("the bytes are truncated, or do not belong here");
        }
    }
    bool empty() const { return rest_.empty(); }

private:
    /// Of things that take a byte each at least.
    std::size_t count() {
        std::uint64_t count = 0;
        raw(&count, 1);
        require(count <= rest_.size());
        return count;
    }
    template <class T>
    void get(T& value) {
        if constexpr (ListsMembers<T, ArchiveReader>) {
            T::archive(*this, value);
        } else {
            static_assert(PlainValue<T>, "a class with members of its own lists them");
            raw(&value, 1);
        }
    }
    void get(std::string& text) {
        text.resize(count());
        raw(text.data(), text.size());
    }
    template <class T>
    void get(std::vector<T>& values) {
        const std::size_t size = count();
        if constexpr (PlainValue<T> && !ListsMembers<T, ArchiveReader>) {
            require(size <= rest_.size() / sizeof(T));
            values.resize(size);
            raw(values.data(), size);
        } else {
            values.clear();
            for (std::size_t i = 0; i < size; ++i) {
                get(values.emplace_back());
            }
        }
    }
    template <class Key, class T>
    void get(std::map<Key, T>& values) {
        values.clear();
        for (std::size_t i = count(); i > 0; --i) {
            Key key{};
            get(key);
            get(values[key]);
        }
    }
    template <class... T>
    void get(std::tuple<T...>& values) {
        std::apply([this](T&... each) { (get(each), ...); }, values);
    }

    std::string_view rest_;
};

}  // namespace wend
