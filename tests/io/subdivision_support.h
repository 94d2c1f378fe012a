// What the tests of subdivision share.
#pragma once

#include <wend/io/load/subdivision.h>

#include <gtest/gtest.h>

namespace wend::test {

inline TriangleMeshData limit_of(const ControlMesh& control, int levels, const SubdivisionRules& rules = {}) {
    const auto mesh = limit_surface(control, rules, levels);
    EXPECT_TRUE(mesh);
    return mesh.value_or(TriangleMeshData{});
}

}  // namespace wend::test
