// Measured reflections.
#pragma once

#include <wend/scene/bsdf/measured.h>

#include <filesystem>
#include <memory>

namespace wend {

/// Reads a ".bsdf" file of dupuy2018, of spectra or of colours ("rgb"). Throws InputError where it lacks a table, or
/// one has another shape than the rest of the file says, or numbers that are not finite.
std::shared_ptr<const MeasuredTables> read_measured(const std::filesystem::path& file);

}  // namespace wend
