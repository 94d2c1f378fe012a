// The frames of a film that one call renders: their numbers, their names, and one after another.
#pragma once

#include <wend/app/options.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace wend {

/// "1-48", "1-48x2" (every second) or "7". Throws InputError.
std::vector<int> parse_frames(const std::string& text);

/// Whether a frame's number has a place in the name: a group of '#'.
bool has_frame_number(const std::string& name);

/// The name with the frame's number for its group of '#', with at least as many digits. Throws InputError where there
/// are two groups.
std::string with_frame_number(const std::string& name, int frame);

/// Renders one after another: frames, or scenes, as `kind` calls them. What goes wrong in one is reported, and the
/// others are rendered all the same; at the end the first error's kind is thrown, with the names of all that failed. A
/// signal (EndedBySignal) ends all.
void for_each_in_turn(const std::string& kind, const std::vector<std::string>& names, const Streams& streams,
                      const std::function<void(std::size_t)>& render);

}  // namespace wend
