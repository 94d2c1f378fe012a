#include <wend/io/tensor_file.h>

#include <wend/io/bytes.h>
#include <wend/io/gzip.h>

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace wend {
namespace {

enum class NumberType : std::uint8_t { float32 = 10, last = 11 };

/// Of which the header holds where they are.
struct Entry {
    std::string name;
    NumberType type = NumberType::last;
    std::uint64_t offset = 0;
    std::vector<std::size_t> shape;
};

Entry take_entry(Bytes& bytes, const Place& place) {
    Entry entry;
    entry.name = std::string(bytes.take(bytes.take<std::uint16_t>()));
    const auto dimensions = bytes.take<std::uint16_t>();
    entry.type = bytes.take<NumberType>();
    if (entry.type > NumberType::last) {
        throw InputError(place, fmt::format("the array \"{}\" is of an unknown type", entry.name));
    }
    entry.offset = bytes.take<std::uint64_t>();
    for (int i = 0; i < dimensions; ++i) {
        entry.shape.push_back(bytes.take<std::uint64_t>());
    }
    return entry;
}

/// How many numbers an array has; throws where no file could hold them.
std::uint64_t count_of(const Entry& entry, const Place& place) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max() / sizeof(float);
    std::uint64_t count = 1;
    for (const std::uint64_t size : entry.shape) {
        if (size > 0 && count > most / size) {
            throw InputError(place, fmt::format("the array \"{}\" is too large", entry.name));
        }
        count *= size;
    }
    return count;
}

}  // namespace

std::map<std::string, Tensor> read_tensors(const std::filesystem::path& file) {
    using namespace std::string_view_literals;
    constexpr std::string_view signature = "tensor_file\0\1\0"sv;
    const Place place{file.string(), 0, 0};
    const std::string content = read_file(file);
    Bytes bytes(content, place);
    if (!std::string_view(content).starts_with(signature)) {
        throw InputError(place, "this is no tensor file of version 1.0");
    }
    bytes.take(signature.size());
    const auto entries = bytes.take<std::uint32_t>();
    std::map<std::string, Tensor> tensors;
    std::uint64_t taken_so_far = 0;
    for (std::uint32_t i = 0; i < entries; ++i) {
        const Entry entry = take_entry(bytes, place);
        if (entry.type != NumberType::float32) {
            continue;
        }
        const std::uint64_t size = count_of(entry, place) * sizeof(float);
        Bytes data(content, place);
        data.seek(entry.offset);
        const std::string_view taken = data.take(size);
        // Where arrays share their bytes, a small file would fill any memory.
        taken_so_far += size;
        if (taken_so_far > content.size()) {
            throw InputError(place, fmt::format("the array \"{}\" lies where others do", entry.name));
        }
        Tensor tensor{entry.shape, std::vector<float>(size / sizeof(float))};
        if (size > 0) {
            std::memcpy(tensor.values.data(), taken.data(), size);
        }
        tensors.insert_or_assign(entry.name, std::move(tensor));
    }
    return tensors;
}

}  // namespace wend
