// What is said of a path's vertex. A segment that is null, because its storage was full, is left alone.
#pragma once

#include <openpgl/cpp/Region.h>
#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

using PathSegment = PGLPathSegmentData;

inline void Reset(PathSegment* pathSegment) {
    if (pathSegment) {
        *pathSegment = PathSegment();
    }
}

#define OPENPGL_SETTER(name, type, member)                        \
    inline void Set##name(PathSegment* pathSegment, type value) { \
        if (pathSegment) {                                        \
            pathSegment->member = value;                          \
        }                                                         \
    }
OPENPGL_SETTER(Position, const pgl_point3f&, position)
OPENPGL_SETTER(Normal, const pgl_vec3f&, normal)
OPENPGL_SETTER(DirectionIn, const pgl_vec3f&, directionIn)
OPENPGL_SETTER(DirectionOut, const pgl_vec3f&, directionOut)
OPENPGL_SETTER(PDFDirectionIn, const float&, pdfDirectionIn)
OPENPGL_SETTER(VolumeScatter, const bool&, volumeScatter)
OPENPGL_SETTER(ScatteringWeight, const pgl_vec3f&, scatteringWeight)
OPENPGL_SETTER(TransmittanceWeight, const pgl_vec3f&, transmittanceWeight)
OPENPGL_SETTER(DirectContribution, const pgl_vec3f&, directContribution)
OPENPGL_SETTER(ScatteredContribution, const pgl_vec3f&, scatteredContribution)
OPENPGL_SETTER(MiWeight, const float&, miWeight)
OPENPGL_SETTER(RussianRouletteProbability, const float&, russianRouletteSurvivalProbability)
OPENPGL_SETTER(RussianRouletteSurvivalProbability, const float&, russianRouletteSurvivalProbability)
OPENPGL_SETTER(Eta, const float&, eta)
OPENPGL_SETTER(IsDelta, const bool&, isDelta)
OPENPGL_SETTER(Roughness, const float&, roughness)
#undef OPENPGL_SETTER

inline pgl_vec3f GetDirectionIn(PathSegment* pathSegment) {
    return pathSegment ? pathSegment->directionIn : PathSegment().directionIn;
}
inline void AddDirectContribution(PathSegment* pathSegment, const pgl_vec3f& directContribution) {
    if (pathSegment) {
        pglVec3fAdd(pathSegment->directContribution, directContribution);
    }
}
inline void AddScatteredContribution(PathSegment* pathSegment, const pgl_vec3f& scatteredContribution) {
    if (pathSegment) {
        pglVec3fAdd(pathSegment->scatteredContribution, scatteredContribution);
    }
}
inline void SetRegion(PathSegment* pathSegment, const Region& region) {
    if (pathSegment) {
        pathSegment->regionPtr = region.m_regionHandle;
    }
}

}  // namespace cpp
}  // namespace openpgl
