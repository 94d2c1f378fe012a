// Guided walks inside dense media: docs/subsurface_in_your_renderer.md and examples/subsurface show how.
#pragma once

#include <wend/core/frame.h>
#include <wend/core/random.h>
#include <wend/core/ray.h>
#include <wend/sampling/warp.h>
#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/subsurface/technique_mixes.h>
