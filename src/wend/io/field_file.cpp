#include <wend/guide/sealed_bytes.h>
#include <wend/guide/serialization.h>
#include <wend/io/field_file.h>
#include <wend/io/parts_file.h>

#include <array>
#include <string>

namespace wend {
namespace {

constexpr std::string_view signature = "WENDFIELDS\n";
// The version is that of what a render notes (render/taught.h).
constexpr guide::SealedKind notes{"notes of a guiding field", "notes", "WENDNOTE\x1a", 1};

}  // namespace

void write_fields(const std::filesystem::path& file, const guide::Fields& fields) {
    write_parts(
        file, signature,
        std::array{guide::to_bytes(fields.surface), guide::to_bytes(fields.volume), guide::seal(notes, fields.notes)});
}

guide::Fields read_fields(const std::filesystem::path& file) {
    // Older files have no notes.
    const PartsFile parts(file, signature, 3, "guiding fields", 1);
    guide::Fields fields{parts.decode(0, guide::field_from_bytes), parts.decode(1, guide::field_from_bytes)};
    if (parts.size() > 2) {
        fields.notes = parts.decode(2, [](std::string_view bytes) { return std::string(guide::unseal(notes, bytes)); });
    }
    return fields;
}

}  // namespace wend
