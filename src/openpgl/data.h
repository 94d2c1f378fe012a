// What a renderer hands over: samples of incident radiance, and the segments of a path that they are made from.
#pragma once

#include <openpgl/common.h>

#ifndef __cplusplus
// PGLSampleData::flags, by the names that C++ has them by within the structure.
enum { EInsideVolume = 1, EDirectLight = 2, ENextEventVolume = 4 };
#endif

/// An estimate of the radiance that arrives at a point from one direction.
typedef struct PGLSampleData {
#ifdef __cplusplus
    enum Flags {
        EInsideVolume = 1 << 0,     ///< a collision in a medium: the field of volumes learns from it
        EDirectLight = 1 << 1,      ///< straight from a light
        ENextEventVolume = 1 << 2,  ///< the path met a medium next, and no surface
    };
#endif
    pgl_point3f position;
    pgl_direction direction;  ///< towards where the radiance comes from
    float weight;             ///< the radiance, as a scalar, divided by `pdf`
    float pdf;                ///< the direction was drawn with, in 1/sr
    float distance;           ///< to where the radiance comes from; unknown, or without end, where it is not positive
    uint32_t flags;
} PGLSampleData;

/// A direction in which a path went and found nothing.
typedef struct PGLZeroValueSampleData {
    pgl_point3f position;
    pgl_direction direction;
    bool volume;  ///< whether the position is a collision in a medium
} PGLZeroValueSampleData;

/// A vertex of a path and the way from there to the next one. "In" is where the path goes, since radiance comes in from
/// there, and "out" is where it came from.
typedef struct PGLPathSegmentData {
    pgl_point3f position OPENPGL_DEFAULT(0, 0, 0);
    pgl_vec3f directionIn OPENPGL_DEFAULT(0, 1, 0);   ///< drawn here, towards the next vertex
    pgl_vec3f directionOut OPENPGL_DEFAULT(1, 0, 0);  ///< towards the vertex before
    pgl_vec3f normal OPENPGL_DEFAULT(0, 0, 1);        ///< of a surface
    bool volumeScatter OPENPGL_DEFAULT(false);        ///< a collision in a medium
    float pdfDirectionIn OPENPGL_DEFAULT(1);          ///< in 1/sr
    bool isDelta OPENPGL_DEFAULT(false);              ///< `directionIn` is one of a discrete set, a mirror's
    /// The scattering function, with its cosine, over pdfDirectionIn.
    pgl_vec3f scatteringWeight OPENPGL_DEFAULT(1, 1, 1);
    /// Of the flight to the next vertex: transmittance over the density of the flight.
    pgl_vec3f transmittanceWeight OPENPGL_DEFAULT(1, 1, 1);
    /// Light that is emitted here, towards directionOut.
    pgl_vec3f directContribution OPENPGL_DEFAULT(0, 0, 0);
    /// Of directContribution in multiple importance sampling, which that does not contain.
    float miWeight OPENPGL_DEFAULT(1);
    /// Light that connections brought and that is scattered here towards directionOut.
    pgl_vec3f scatteredContribution OPENPGL_DEFAULT(0, 0, 0);
    /// The probability with which the path went on from here.
    float russianRouletteSurvivalProbability OPENPGL_DEFAULT(1);
    float eta OPENPGL_DEFAULT(1);        ///< the index of refraction
    float roughness OPENPGL_DEFAULT(1);  ///< of a surface; 0 for a mirror
    const void* regionPtr OPENPGL_DEFAULT(0);
} PGLPathSegmentData;

/// Text that belongs to the caller: pglReleaseString() ends it.
typedef struct PGLString {
    char* m_str;
    size_t m_size;  ///< the byte at its end included
} PGLString;
