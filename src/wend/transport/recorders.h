// The recorders that walks come with.
#pragma once

#include <wend/transport/field_recorder.h>
#include <wend/transport/interior_recorder.h>
#include <wend/transport/light_recorder.h>
#include <wend/transport/reflection_recorder.h>
#include <wend/transport/walk_recorder.h>

namespace wend {

/// Two of them are asked, too: what the field takes, and how contributions hang on the technique mix.
using StandardRecorders = WalkRecorder<FieldRecorder, InteriorRecorder, LightRecorder, ReflectionRecorder>;

}  // namespace wend
