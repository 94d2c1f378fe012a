// The learned field, its training, and the decisions that follow it: all that a renderer needs to guide its own walks.
// docs/embedding.md and examples/embed show how.
#pragma once

#if __cplusplus < 202002L
#error "Wend's headers are C++20: compile with -std=c++20 or later"
#endif

#include <wend/decision/direction.h>
#include <wend/decision/guided_distance.h>
#include <wend/decision/learned_lights.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/guide/field.h>
#include <wend/guide/fit.h>
#include <wend/guide/path_log.h>

/// Zero-variance-based path sampling: what walks ask, the decisions that they take, media and their walks inside.
namespace wend {

/// The learned field: records of walks in, incident radiance out.
namespace guide {}

}  // namespace wend
