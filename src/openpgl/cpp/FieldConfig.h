// How a field is to learn.
#pragma once

#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

struct FieldConfig {
    FieldConfig() = default;
    FieldConfig(const FieldConfig&) = delete;
    ~FieldConfig() { pglReleaseFieldArguments(m_args); }

    void Init(PGL_SPATIAL_STRUCTURE_TYPE spatialType, PGL_DIRECTIONAL_DISTRIBUTION_TYPE directionalType,
              bool deterministic = true, size_t maxSamplesPerLeaf = PGL_TREE_MAX_SAMPLE_PER_LEAF) {
        pglReleaseFieldArguments(m_args);
        pglFieldArgumentsSetDefaults(m_args, spatialType, directionalType, deterministic, maxSamplesPerLeaf);
    }
    /// Most splits above a cell.
    void SetSpatialStructureArgMaxDepth(size_t maxDepth) {
        if (PGLKDTreeArguments* tree = Tree()) {
            tree->maxDepth = maxDepth;
        }
    }
    // There is no neighbour to choose: lobes turn with the place within a cell. Always fitted, too.
    void SetUseKnnLookup(bool useKnnLookup) {
        if (PGLKDTreeArguments* tree = Tree()) {
            tree->knnLookup = useKnnLookup;
        }
    }
    void SetUseKnnIsLookup(bool useKnnIsLookup) {
        if (PGLKDTreeArguments* tree = Tree()) {
            tree->isKnnLookup = useKnnIsLookup;
        }
    }
    void SetVarianceBasedVSP(bool /*varianceBasedVSP*/) {}
    void SetDebugArgFitRegions(bool fitRegions) { m_args.debugArguments.fitRegions = fitRegions; }

private:
    friend struct Field;
    PGLKDTreeArguments* Tree() const { return static_cast<PGLKDTreeArguments*>(m_args.spatialSturctureArguments); }

    PGLFieldArguments m_args;
};

}  // namespace cpp
}  // namespace openpgl
