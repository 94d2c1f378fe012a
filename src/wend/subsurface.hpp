// Guided walks inside dense media: docs/subsurface_in_your_renderer.md and examples/subsurface show how.
#pragma once

#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>
