// Curves that become one surface.
#pragma once

#include <wend/io/load/context.h>
#include <wend/scene/scene.h>

#include <cstddef>
#include <map>
#include <vector>

namespace wend {

/// Hairs are directives of their own: those alike become one surface.
class JoinedCurves {
public:
    /// The context and the description are referred to.
    JoinedCurves(LoadContext& context, const pbrt::Description& description)
        : context_(context), description_(description) {}

    /// A surface that more curves may join; `directive`: the index of its shape.
    void begin(int surface, CurveSet set, std::size_t directive);
    /// Whether `added`, which is not one of the surfaces yet, was added to the one with this index.
    bool join(int surface, const std::vector<Surface>& surfaces, const Surface& added, std::size_t directive);
    /// Gives surfaces all the curves that joined them; the earlier scene's, where they are the same.
    void finish(std::vector<Surface>& surfaces);

private:
    struct Curves {
        CurveSet set;
        std::vector<std::size_t> directives;
    };

    const SharedShape* earlier(const std::vector<std::size_t>& directives) const;

    LoadContext& context_;
    const pbrt::Description& description_;
    std::map<int, Curves> curves_;  ///< by surface
};

}  // namespace wend
