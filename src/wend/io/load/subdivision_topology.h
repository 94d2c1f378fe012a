// A control mesh in the terms of OpenSubdiv.
#pragma once

#include <wend/io/load/subdivision.h>

#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

namespace wend {

/// The mesh without faces that have a vertex twice, and without creases along what is no edge; null if no face is left.
/// Throws as limit_surface() does.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> connect(const ControlMesh& control, const SubdivisionRules& rules);

}  // namespace wend
