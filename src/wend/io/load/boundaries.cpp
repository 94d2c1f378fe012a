#include <wend/io/load/boundaries.h>

#include <wend/scene/boundary_faults.h>
#include <wend/scene/medium_faults.h>

#include <fmt/format.h>

#include <algorithm>

namespace wend {
namespace {

constexpr std::size_t most_warnings = 8;

std::string describe(const BoundaryFault& fault, const std::string& medium) {
    const Vec3& p = fault.position;
    const std::string edges =
        fmt::format("{} edge{}, {}near ({:.4g}, {:.4g}, {:.4g})", fault.edges, fault.edges == 1 ? "" : "s",
                    fault.edges == 1 ? "" : "the first ", p.x, p.y, p.z);
    switch (fault.kind) {
        case BoundaryFault::Kind::open:
            return fmt::format("the boundary of {} is open: it ends at {}, where light gets out or in unnoticed",
                               medium, edges);
        case BoundaryFault::Kind::contrary:
            return fmt::format("the boundary of {} is badly oriented: neighbouring triangles face opposite ways at {}",
                               medium, edges);
        case BoundaryFault::Kind::inside_out:
            return fmt::format(
                "the boundary of {} is inside out: the medium fills all that is not within it (ReverseOrientation "
                "turns a shape)",
                medium);
    }
    return {};
}

std::string in_quotes(const std::vector<std::string>& names, MediumId id) {
    const std::string& name = id == vacuum ? std::string() : names[static_cast<std::size_t>(id)];
    return id == vacuum ? "\"\"" : name.empty() ? "a medium without a name" : fmt::format("\"{}\"", name);
}

std::string describe(const MediumFault& fault, const std::vector<std::string>& names) {
    const std::string medium = in_quotes(names, fault.medium), around = in_quotes(names, fault.around);
    switch (fault.kind) {
        case MediumFault::Kind::camera:
            return fmt::format(
                "the camera is in {} as the surfaces around it tell, but the scene does not say so: walks begin "
                "outside of it (MediumInterface \"\" {} before Camera puts them there)",
                medium, medium);
        case MediumFault::Kind::nested:
            return fmt::format(
                "this boundary of {} lies within {} but does not name it: {} is taken to go on around it "
                "(MediumInterface {} {} says so)",
                medium, around, around, medium, around);
        case MediumFault::Kind::overlap:
            return fmt::format("this boundary of {} lies partly within {}: where both are, the smaller is taken",
                               medium, around);
    }
    return {};
}

}  // namespace

void warn_of_boundaries(LoadContext& context, const SceneDescription& scene, const std::vector<Place>& places,
                        const std::vector<std::string>& names, const Place& camera) {
    const std::vector<BoundaryFault> faults = boundary_faults(scene);
    for (std::size_t i = 0; i < std::min(faults.size(), most_warnings); ++i) {
        const BoundaryFault& fault = faults[i];
        const std::string& name = names[static_cast<std::size_t>(fault.medium)];
        std::string text = describe(fault, name.empty() ? "the medium inside" : fmt::format("medium \"{}\"", name));
        if (i + 1 == most_warnings && faults.size() > most_warnings) {
            text += fmt::format("; {} more like this are not listed", faults.size() - most_warnings);
        }
        context.warnings.add(places[static_cast<std::size_t>(fault.surface)], text);
    }
    for (const MediumFault& fault : medium_faults(scene)) {
        // The medium of a material can be named by nobody.
        const bool can_be_named = fault.medium == vacuum || !names[static_cast<std::size_t>(fault.medium)].empty();
        if (can_be_named || fault.kind != MediumFault::Kind::camera) {
            const Place& place = fault.surface < 0 ? camera : places[static_cast<std::size_t>(fault.surface)];
            context.warnings.add(place, describe(fault, names));
        }
    }
}

}  // namespace wend
