// Rendering a reference where none is at hand.
#pragma once

#include <wend/app/reference.h>
#include <wend/app/session.h>

#include <filesystem>
#include <functional>
#include <string>

namespace wend {

/// Unless it is said otherwise, each half of a reference takes this many times as long as what it judges, and so has as
/// many times its samples.
inline constexpr int reference_effort = 8;

/// What each half of a reference may take: samples per pixel where these are positive, or else seconds.
struct ReferenceEffort {
    int samples = 0;
    double seconds = 0;
};

/// "64 spp" or "40 s".
std::string to_string(const ReferenceEffort& effort);

/// Renders two independent halves with full guiding. Where `name` is not empty, it keeps them as the pair of that name.
/// `watch` is told of each half, 0 or 1, as it goes on, first at its start; it may throw.
KnownReference render_reference(const Session& session, const ReferenceEffort& effort,
                                const std::filesystem::path& name,
                                const std::function<void(int half, const RenderProgress& progress)>& watch);

}  // namespace wend
