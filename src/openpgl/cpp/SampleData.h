// Samples.
#pragma once

#include <openpgl/data.h>

namespace openpgl {
namespace cpp {

using SampleData = PGLSampleData;
using ZeroValueSampleData = PGLZeroValueSampleData;

}  // namespace cpp
}  // namespace openpgl
