// Checkpoints of `wend render`: what they say of their render, and which renders they fit.
#pragma once

#include <wend/app/session.h>
#include <wend/render/render.h>

#include <filesystem>
#include <string>
#include <vector>

namespace wend {

/// Writes where a render is. Throws std::runtime_error where that fails; an older checkpoint of that name stays.
void save_checkpoint(const std::filesystem::path& file, const Render& render, const Session& session,
                     const RenderSettings& settings);

/// Lets a render that has not begun go on from a checkpoint. Throws InputError naming the file, and what is different,
/// where scene or settings are not those that it was written with. How long to render, and with how many threads, may
/// differ.
void resume_from(const std::filesystem::path& file, Render& render, const Session& session,
                 const RenderSettings& settings);

/// The names of the layers that a checkpoint's render was asked for. Throws InputError for a file that is no checkpoint
/// or does not say.
std::vector<std::string> layers_in_checkpoint(const std::filesystem::path& file);

}  // namespace wend
