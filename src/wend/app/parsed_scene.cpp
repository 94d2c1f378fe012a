#include <wend/app/parsed_scene.h>
#include <wend/io/load/parse_scene.h>

#include <utility>

namespace wend {

ParsedScene::ParsedScene(const SceneOptions& options, pbrt::Description description, std::string changes)
    : options_(options),
      description_(std::move(description)),
      changes_(std::move(changes)),
      session_(options_, {}, description_, changes_) {
}

std::shared_ptr<ParsedScene> ParsedScene::load(const SceneOptions& options) {
    options.check();
    return std::make_shared<ParsedScene>(options, parse_scene(options.file), std::string());
}

std::shared_ptr<ParsedScene> ParsedScene::of_text(std::string text, const std::filesystem::path& folder,
                                                  const SceneOptions& options) {
    options.check();
    pbrt::Description description = parse_scene(text, folder, options.file);
    return std::make_shared<ParsedScene>(options, std::move(description), std::move(text));
}

}  // namespace wend
