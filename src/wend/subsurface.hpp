// Guided walks inside dense media: docs/subsurface_in_your_renderer.md and examples/subsurface show how.
#pragma once

#if __cplusplus < 202002L
#error "Wend's headers are C++20: compile with -std=c++20 or later"
#endif

#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/sampling/warp.h>
#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/subsurface/technique_mixes.h>
