#include <wend/io/field_file.h>

#include <wend/guide/field.h>
#include <wend/guide/sealed_bytes.h>
#include <wend/io/parts_file.h>

#include <array>
#include <string>

namespace wend {
namespace {

constexpr std::string_view field_signature = "WENDFIELDS\n";
// The version is that of what a render notes (render/taught.h).
constexpr guide::SealedKind notes{"notes of a guiding field", "notes", "WENDNOTE\x1a", 3};
constexpr guide::SealedKind digest{"scene of a guiding field", "a scene's digest", "WENDSCENE\x1a", 1};

}  // namespace

void write_fields(const std::filesystem::path& file, const guide::Fields& fields, const std::string& scene) {
    write_parts(file, field_signature,
                std::array{guide::to_bytes(fields.surface), guide::to_bytes(fields.volume),
                           guide::seal(notes, fields.notes), guide::seal(digest, scene)});
}

guide::Fields read_fields(const std::filesystem::path& file) {
    return read_saved_fields(file).fields;
}

SavedFields read_saved_fields(const std::filesystem::path& file) {
    // Older files have no scene, or no notes either.
    const PartsFile parts(file, field_signature, 4, "guiding fields", 2);
    SavedFields saved{{parts.decode(0, guide::field_from_bytes), parts.decode(1, guide::field_from_bytes)}, {}};
    const auto text = [&](std::size_t part, const guide::SealedKind& kind) {
        return parts.decode(part, [&](std::string_view bytes) { return std::string(guide::unseal(kind, bytes)); });
    };
    if (parts.size() > 2) {
        saved.fields.notes = text(2, notes);
    }
    if (parts.size() > 3) {
        saved.scene = text(3, digest);
    }
    return saved;
}

}  // namespace wend
