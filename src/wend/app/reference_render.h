// Rendering a reference where none is at hand.
#pragma once

#include <wend/app/session.h>
#include <wend/film/metrics.h>

#include <filesystem>
#include <functional>

namespace wend {

/// Each half of a reference takes this many times as long as what it judges, and so has as many times its samples.
inline constexpr int reference_effort = 8;

/// Renders two independent halves with full guiding, for `reference_effort` times `seconds` each. Where `name` is not
/// empty, it keeps them as the pair of that name. `watch` is told of each half, 0 or 1, as it goes on, first at its
/// start; it may throw.
Reference render_reference(const Session& session, double seconds, const std::filesystem::path& name,
                           const std::function<void(int half, const RenderProgress& progress)>& watch);

}  // namespace wend
