#include <wend/core/error.h>
#include <wend/guide/serialization.h>
#include <wend/io/atomic_file.h>
#include <wend/io/bytes.h>
#include <wend/io/field_file.h>

#include <fstream>
#include <iterator>
#include <string>

namespace wend {
namespace {

constexpr std::string_view signature = "WENDFIELDS\n";

void append(std::string& out, const guide::Field& field) {
    const std::string bytes = guide::to_bytes(field);
    const auto size = static_cast<std::uint64_t>(bytes.size());
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
    out += bytes;
}

}  // namespace

void write_fields(const std::filesystem::path& file, const GuidingFields& fields) {
    std::string out(signature);
    append(out, fields.surface);
    append(out, fields.volume);
    write_atomically(file, out);
}

GuidingFields read_fields(const std::filesystem::path& file) {
    const Place place{file.string(), 0, 0};
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file)) {
        throw InputError(place, "cannot be read");
    }
    const std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (std::string_view(content).substr(0, signature.size()) != signature) {
        throw InputError(place, "is no file of guiding fields");
    }
    Bytes bytes(content, place);
    bytes.seek(signature.size());
    const auto next = [&] {
        const auto size = bytes.take<std::uint64_t>();
        try {
            return guide::field_from_bytes(bytes.take(size));
        } catch (const InputError& error) {
            const std::string what = error.what();
            throw InputError(what.starts_with(place.file) ? what : to_string(place) + ": error: " + what);
        }
    };
    guide::Field surface = next();
    GuidingFields fields{std::move(surface), next()};
    if (!bytes.empty()) {
        throw InputError(place, "has more bytes than two fields");
    }
    return fields;
}

}  // namespace wend
