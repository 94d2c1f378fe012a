#include <wend/io/load/joined_curves.h>

#include <wend/io/load/curves.h>
#include <wend/io/load/loaded_parts.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace wend {

void JoinedCurves::begin(int surface, CurveSet set, std::size_t directive) {
    curves_.try_emplace(surface, Curves{std::move(set), {directive}});
}

bool JoinedCurves::join(int surface, const std::vector<Surface>& surfaces, const Surface& added,
                        std::size_t directive) {
    const Surface& last = surfaces[static_cast<std::size_t>(surface)];
    const auto curves = curves_.find(surface);
    if (curves == curves_.end() || last.material != added.material || last.interior != added.interior ||
        last.exterior != added.exterior || last.flip_normal != added.flip_normal || last.alpha != added.alpha ||
        last.view != added.view || !merge(curves->second.set, std::get<CurveSet>(*added.shape))) {
        return false;
    }
    curves->second.directives.push_back(directive);
    return true;
}

void JoinedCurves::finish(std::vector<Surface>& surfaces) {
    for (auto& [surface, curves] : curves_) {
        SharedShape& shape = surfaces[static_cast<std::size_t>(surface)].shape;
        if (const SharedShape* known = earlier(curves.directives)) {
            shape = *known;
        } else {
            shape = std::move(curves.set);
        }
        if (context_.parts) {
            LoadedCurves loaded{std::move(curves.directives), {}, shape};
            for (const std::size_t directive : loaded.directives) {
                loaded.parameters.push_back(description_.shapes[directive].parameters);
            }
            context_.parts->curves.emplace(loaded.directives.front(), std::move(loaded));
        }
    }
    curves_.clear();
}

const SharedShape* JoinedCurves::earlier(const std::vector<std::size_t>& directives) const {
    if (!context_.earlier) {
        return nullptr;
    }
    const auto found = context_.earlier->curves.find(directives.front());
    if (found == context_.earlier->curves.end() || found->second.directives != directives) {
        return nullptr;
    }
    const auto is_same = [&](const pbrt::ParameterSet& known, std::size_t directive) {
        return known.is_same_as(description_.shapes[directive].parameters);
    };
    const LoadedCurves& known = found->second;
    return std::equal(known.parameters.begin(), known.parameters.end(), directives.begin(), is_same) ? &known.shape
                                                                                                     : nullptr;
}

}  // namespace wend
