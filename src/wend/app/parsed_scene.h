// A scene for those who call the renderer from a program: with what it was loaded from, so that it can be changed.
#pragma once

#include <wend/app/session.h>
#include <wend/io/load/loaded_parts.h>
#include <wend/io/pbrt/description.h>

#include <filesystem>
#include <memory>
#include <string>

namespace wend {

class ParsedScene {
public:
    /// Of `options.file`. Throws InputError, as all of these do.
    static std::shared_ptr<ParsedScene> load(const SceneOptions& options);
    /// Of a text; it refers to files in the folder. `options.file` is what messages call it.
    static std::shared_ptr<ParsedScene> of_text(const std::string& text, const std::filesystem::path& folder,
                                                const SceneOptions& options);
    /// `changes` says in which way it is not that of the files; empty: in none. An earlier scene is one whose
    /// description differs in parameters alone: shapes, media and files that the changed ones do not touch are not
    /// loaded again, and all that is the same in memory is so once.
    ParsedScene(const SceneOptions& options, pbrt::Description description, std::string changes,
                const ParsedScene* earlier = nullptr);

    const Session& session() const { return session_; }
    const pbrt::Description& description() const { return description_; }
    const SceneOptions& options() const { return options_; }
    const std::string& changes() const { return changes_; }

private:
    SceneOptions options_;
    pbrt::Description description_;
    std::string changes_;
    LoadedParts parts_;
    Session session_;
};

}  // namespace wend
