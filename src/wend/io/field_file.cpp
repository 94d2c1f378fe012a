#include <wend/guide/serialization.h>
#include <wend/io/field_file.h>
#include <wend/io/parts_file.h>

#include <array>

namespace wend {
namespace {

constexpr std::string_view signature = "WENDFIELDS\n";

}  // namespace

void write_fields(const std::filesystem::path& file, const guide::Fields& fields) {
    write_parts(file, signature, std::array{guide::to_bytes(fields.surface), guide::to_bytes(fields.volume)});
}

guide::Fields read_fields(const std::filesystem::path& file) {
    const PartsFile parts(file, signature, 2, "guiding fields");
    return {parts.decode(0, guide::field_from_bytes), parts.decode(1, guide::field_from_bytes)};
}

}  // namespace wend
