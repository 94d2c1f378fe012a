#include <wend/app/parsed_scene.h>

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
    ReadScene read = read_scene(options);
    return std::make_shared<ParsedScene>(options, std::move(read.description), std::move(read.changes));
}

std::shared_ptr<ParsedScene> ParsedScene::of_text(const std::string& text, const std::filesystem::path& folder,
                                                  const SceneOptions& options) {
    options.check();
    ReadScene read = read_scene(text, folder, options);
    return std::make_shared<ParsedScene>(options, std::move(read.description), std::move(read.changes));
}

}  // namespace wend
