// What the directives of a pbrt file change for those after them, and the blocks that limit how far.
#pragma once

#include <wend/core/transform.h>
#include <wend/io/pbrt/parameters.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace wend::pbrt {

/// Why a transformation is none: it has no inverse, or is no longer finite.
struct TransformFault {
    Location place;
    std::string text;
};

/// The current transformation matrix at the start and the end of the shutter interval.
struct MovingTransform {
    Transform start{};
    Transform end{};
    /// Set while that at the start, or at the end, is none: until it is set anew, it is the last that was one.
    std::shared_ptr<const TransformFault> fault{};
    std::shared_ptr<const TransformFault> fault_at_end{};

    bool is_moving() const { return !(start == end); }
};

enum class ActiveTransform { start, end, all };

/// Defaults that Attribute directives set, one set a target.
struct AttributeDefaults {
    std::shared_ptr<const ParameterSet> shape, light, material, medium, texture;
};

/// A name that a directive gives to what follows: it must be defined if anything uses it.
struct UsedName {
    std::string name;
    Location place;
};

struct GraphicsState {
    MovingTransform ctm;
    ActiveTransform active = ActiveTransform::all;
    ColourSpace colour_space = ColourSpace::srgb;
    bool reverse_orientation = false;
    std::size_t material = 0;
    std::shared_ptr<const UsedName> named_material;  ///< in place of `material`
    std::shared_ptr<const UsedName> interior;        ///< media; null: vacuum
    std::shared_ptr<const UsedName> exterior;
    std::optional<std::size_t> area_light;
    AttributeDefaults defaults;

    /// Replaces the active transforms by what `change` makes of them. Where the result is singular or no longer finite,
    /// that is a fault from then on: exporters hide objects so, and nothing may be there to be transformed.
    void change_transforms(const std::function<Transform(const Transform&)>& change, const Location& place);
    /// Replaces the active transforms whatever they were.
    void set_transforms(const std::function<Transform()>& make, const Location& place);
};

/// The graphics state, the states saved at the blocks that are open, and the named coordinate systems.
class StateStack {
public:
    /// Blocks are closed by their own kind. An import closes at the end of its file.
    enum class Block { attribute, object, import };

    GraphicsState& current() { return current_; }
    const GraphicsState& current() const { return current_; }
    std::unordered_map<std::string, MovingTransform>& coordinate_systems() { return coordinate_systems_; }

    /// Saves the state. Throws InputError where blocks are nested absurdly deeply.
    void open(Block block, const Location& place);
    /// Brings the saved state back. Throws InputError where the innermost open block is of another kind, or none is
    /// open.
    void close(Block block, const Location& place);
    /// The innermost open block.
    std::optional<Block> innermost() const {
        return saved_.empty() ? std::nullopt : std::optional(saved_.back().block);
    }
    /// Throws InputError at the place of the innermost block still open, if any.
    void require_all_closed() const;

private:
    struct Saved {
        Block block;
        Location place;
        GraphicsState state;
        std::unordered_map<std::string, MovingTransform> coordinate_systems;  // of imports: other blocks keep theirs
    };

    GraphicsState current_;
    std::unordered_map<std::string, MovingTransform> coordinate_systems_;
    std::vector<Saved> saved_;
};

}  // namespace wend::pbrt
