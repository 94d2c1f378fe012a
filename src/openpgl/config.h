// How a field is to learn.
#pragma once

#include <openpgl/common.h>

// Every kind of device is there.
#define OPENPGL_SUPPORT_DEVICE_TYPE_CPU_16

#define PGL_TREE_MAX_SAMPLE_PER_LEAF 32000
#define PGL_VMM_MAX_COMPONENTS 32
#define PGL_VMM_MAX_KAPPA 320000.f

typedef enum PGL_DEVICE_TYPE {
    PGL_DEVICE_TYPE_CPU_4,
    PGL_DEVICE_TYPE_CPU_8,
    PGL_DEVICE_TYPE_CPU_16,
    PGL_DEVICE_TYPE_NONE
} PGL_DEVICE_TYPE;

typedef enum PGL_SPATIAL_STRUCTURE_TYPE { PGL_SPATIAL_STRUCTURE_KDTREE = 0 } PGL_SPATIAL_STRUCTURE_TYPE;

typedef enum PGL_DIRECTIONAL_DISTRIBUTION_TYPE {
    PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM = 0,
    PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE,
    PGL_DIRECTIONAL_DISTRIBUTION_VMM
} PGL_DIRECTIONAL_DISTRIBUTION_TYPE;

/// Of these maxSamples and maxDepth count (docs/openpgl.md).
typedef struct PGLKDTreeArguments {
    bool knnLookup OPENPGL_DEFAULT(true);
    bool isKnnLookup OPENPGL_DEFAULT(false);
    size_t minSamples OPENPGL_DEFAULT(100);
    size_t maxSamples OPENPGL_DEFAULT(PGL_TREE_MAX_SAMPLE_PER_LEAF);
    size_t maxDepth OPENPGL_DEFAULT(32);
} PGLKDTreeArguments;

/// Kept, and not looked at: the fit has settings of its own.
typedef struct PGLVMMFactoryArguments {
    size_t initK OPENPGL_DEFAULT(PGL_VMM_MAX_COMPONENTS / 2);
    float initKappa OPENPGL_DEFAULT(5);
    size_t maxK OPENPGL_DEFAULT(PGL_VMM_MAX_COMPONENTS);
    size_t maxEMIterrations OPENPGL_DEFAULT(100);
    float maxKappa OPENPGL_DEFAULT(PGL_VMM_MAX_KAPPA);
    float convergenceThreshold OPENPGL_DEFAULT(0.005f);
    float weightPrior OPENPGL_DEFAULT(0.01f);
    float meanCosinePriorStrength OPENPGL_DEFAULT(0.2f);
    float meanCosinePrior OPENPGL_DEFAULT(0);
    bool useSplitAndMerge OPENPGL_DEFAULT(true);
    float splittingThreshold OPENPGL_DEFAULT(0.5f);
    float mergingThreshold OPENPGL_DEFAULT(0.025f);
    bool partialReFit OPENPGL_DEFAULT(true);
    int maxSplitItr OPENPGL_DEFAULT(1);
    int minSamplesForSplitting OPENPGL_DEFAULT(PGL_TREE_MAX_SAMPLE_PER_LEAF / 8);
    int minSamplesForPartialRefitting OPENPGL_DEFAULT(PGL_TREE_MAX_SAMPLE_PER_LEAF / 8);
    int minSamplesForMerging OPENPGL_DEFAULT(PGL_TREE_MAX_SAMPLE_PER_LEAF / 4);
} PGLVMMFactoryArguments;

typedef enum PGLDQTLeafEstimator { REJECTION_SAMPLING = 0, PER_LEAF } PGLDQTLeafEstimator;
typedef enum PGLDQTSplitMetric { MEAN = 0, SECOND_MOMENT } PGLDQTSplitMetric;

/// Kept, and not looked at: there are no quadtrees.
typedef struct PGLDQTFactoryArguments {
    PGLDQTLeafEstimator leafEstimator OPENPGL_DEFAULT(REJECTION_SAMPLING);
    PGLDQTSplitMetric splitMetric OPENPGL_DEFAULT(MEAN);
    float splitThreshold OPENPGL_DEFAULT(0.01f);
    float footprintFactor OPENPGL_DEFAULT(1);
    uint32_t maxLevels OPENPGL_DEFAULT(12);
} PGLDQTFactoryArguments;

typedef struct PGLDebugArguments {
    bool fitRegions OPENPGL_DEFAULT(true);
} PGLDebugArguments;

/// From pglFieldArgumentsSetDefaults(), which makes what the pointers point to. Null pointers stand for the defaults.
typedef struct PGLFieldArguments {
    PGL_SPATIAL_STRUCTURE_TYPE spatialStructureType OPENPGL_DEFAULT(PGL_SPATIAL_STRUCTURE_KDTREE);
    void* spatialSturctureArguments OPENPGL_DEFAULT(0);
    PGL_DIRECTIONAL_DISTRIBUTION_TYPE directionalDistributionType
        OPENPGL_DEFAULT(PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM);
    void* directionalDistributionArguments OPENPGL_DEFAULT(0);
    bool deterministic OPENPGL_DEFAULT(true);
    PGLDebugArguments debugArguments;
} PGLFieldArguments;
