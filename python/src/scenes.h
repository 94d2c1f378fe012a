// Scenes as Python holds them.
#pragma once

#include <wend/app/session.h>
#include <wend/io/pbrt/description.h>

#include <string>
#include <vector>

namespace wend::python {

/// A scene that is loaded, and what it was loaded from, so that parameters can be changed.
class PythonScene {
public:
    PythonScene(const SceneOptions& options, pbrt::Description description, std::string changes);

    const Session& session() const { return session_; }
    const pbrt::Description& description() const { return description_; }
    const SceneOptions& options() const { return options_; }
    /// What was changed of the files, as text; empty: nothing.
    const std::string& changes() const { return changes_; }

private:
    SceneOptions options_;
    pbrt::Description description_;
    std::string changes_;
    Session session_;
};

}  // namespace wend::python
