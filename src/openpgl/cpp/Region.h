// A cell of a field, of which nothing can be asked. Older renderers pass it on.
#pragma once

#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

struct Region {
    explicit Region(PGLRegion regionHandle) : m_regionHandle(regionHandle) {}

private:
    friend inline void SetRegion(PGLPathSegmentData* pathSegment, const Region& region);
    PGLRegion m_regionHandle;
};

}  // namespace cpp
}  // namespace openpgl
