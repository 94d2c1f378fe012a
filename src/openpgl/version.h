// The version of the interface that these headers have the names and meanings of. (Wend's own is that of its package.)
#pragma once

#define OPENPGL_VERSION_MAJOR 0
#define OPENPGL_VERSION_MINOR 7
#define OPENPGL_VERSION_PATCH 1
#define OPENPGL_VERSION "0.7.1"
#define OPENPGL_VERSION_STRING OPENPGL_VERSION
