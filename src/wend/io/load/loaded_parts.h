// What the directives of a scene led to, for scenes that differ from it in some parameters: what these do not touch is
// not loaded again, but shared.
#pragma once

#include <wend/io/load/context.h>
#include <wend/io/load/pictures.h>
#include <wend/io/volume_file.h>
#include <wend/medium/medium.h>
#include <wend/scene/shape.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace wend {

/// What a directive led to, and what was said and read meanwhile.
template <class T>
struct LoadedPart {
    pbrt::ParameterSet parameters;  ///< that it was loaded of
    T value;
    Warnings warnings;
    std::set<std::filesystem::path> files;
    double subdivided = 0;  ///< LoadContext::subdivided
};

/// The shape of a directive, none for one without triangles.
struct LoadedShape {
    std::optional<SharedShape> shape;
    bool as_mesh = false;  ///< of a kind that may shine or bound a medium
};

/// Curves of several directives that are one shape.
struct LoadedCurves {
    std::vector<std::size_t> directives;  ///< their indices
    std::vector<pbrt::ParameterSet> parameters;
    SharedShape shape;
};

/// Parts by the index of their directive, and files by their name. A value, which holds what scenes have together.
class LoadedParts {
public:
    std::vector<std::optional<LoadedPart<Medium>>> media;
    std::vector<std::optional<LoadedPart<LoadedShape>>> shapes;  ///< none for curves
    std::map<std::size_t, LoadedCurves> curves;                  ///< by their first directive
    std::map<std::tuple<std::string, std::string, PictureChannels>, std::shared_ptr<const Image>> pictures;
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const Volume>> volumes;  ///< by file and grid
};

/// That of the directive at an index: of the earlier scene if the parameters are the same there and `is_same(value)`,
/// and else what `load()` returns.
template <class T, class IsSame, class Load>
T load_part(LoadContext& context, std::vector<std::optional<LoadedPart<T>>> LoadedParts::*list, std::size_t index,
            const pbrt::ParameterSet& parameters, const IsSame& is_same, const Load& load) {
    if (!context.parts) {
        return load();
    }
    auto& parts = context.parts->*list;
    parts.resize(std::max(parts.size(), index + 1));
    if (context.earlier && index < (context.earlier->*list).size()) {
        const auto& known = (context.earlier->*list)[index];
        if (known && known->parameters.is_same_as(parameters) && is_same(known->value)) {
            parts[index] = known;
            context.warnings.add_all(known->warnings);
            context.files->insert(known->files.begin(), known->files.end());
            context.kept_files.insert(known->files.begin(), known->files.end());
            context.subdivided += known->subdivided;
            return known->value;
        }
    }
    Warnings warnings = std::exchange(context.warnings, {});
    std::set<std::filesystem::path> files = std::exchange(*context.files, {});
    const double subdivided = context.subdivided;
    T value = load();
    parts[index] = LoadedPart<T>{parameters, value, context.warnings, *context.files, context.subdivided - subdivided};
    warnings.add_all(context.warnings);
    context.warnings = std::move(warnings);
    context.files->insert(files.begin(), files.end());
    return value;
}

/// What a key stands for in a map of the parts: of this scene or the earlier one, whose `file` is not read again then,
/// and else what `read()` returns, a shared pointer.
template <class Map, class Read>
typename Map::mapped_type read_part(LoadContext& context, Map LoadedParts::*list, const typename Map::key_type& key,
                                    const std::filesystem::path& file, const Read& read) {
    if (!context.parts) {
        return read();
    }
    Map& known = context.parts->*list;
    if (const auto found = known.find(key); found != known.end()) {
        return found->second;
    }
    if (context.earlier) {
        const auto found = (context.earlier->*list).find(key);
        if (found != (context.earlier->*list).end()) {
            context.kept_files.insert(file);
            return known[key] = found->second;
        }
    }
    return known[key] = read();
}

}  // namespace wend
