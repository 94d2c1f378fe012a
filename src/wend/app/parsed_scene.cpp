#include <wend/app/parsed_scene.h>
#include <wend/io/file_stamp.h>
#include <wend/io/load/parse_scene.h>

#include <fmt/format.h>

#include <utility>

namespace wend {

ParsedScene::ParsedScene(const SceneOptions& options, pbrt::Description description, std::string changes,
                         const ParsedScene* earlier)
    : options_(options),
      description_(std::move(description)),
      changes_(std::move(changes)),
      parts_(earlier ? earlier->parts_ : LoadedParts()),
      session_(options_, {}, description_, changes_, parts_, earlier ? &earlier->session_ : nullptr) {
}

std::shared_ptr<ParsedScene> ParsedScene::load(const SceneOptions& options) {
    options.check();
    return std::make_shared<ParsedScene>(options, parse_scene(options.file), std::string());
}

std::shared_ptr<ParsedScene> ParsedScene::of_text(const std::string& text, const std::filesystem::path& folder,
                                                  const SceneOptions& options) {
    options.check();
    // What tells the scene from others has to be kept with all that are made of it: not a long text.
    const FileStamp stamp = stamp_of(text, "text");
    pbrt::Description description = parse_scene(text, folder, options.file);
    return std::make_shared<ParsedScene>(options, std::move(description),
                                         fmt::format("{} {} {:08x}\n", stamp.name, stamp.bytes, stamp.checksum));
}

}  // namespace wend
