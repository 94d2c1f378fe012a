// The renderer as a library, for programs that have none of their own: the target wend::render.
#pragma once

#include <wend/library/renderer.h>
