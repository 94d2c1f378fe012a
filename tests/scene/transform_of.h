// Maps of single precision as transforms.
#pragma once

#include <wend/core/transform.h>

namespace wend::test {

inline Transform transform_of(const AffineMap& map) {
    Transform::Matrix m = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            m[row][column] = double{map.element(row, column)};
        }
    }
    return Transform(m);
}

}  // namespace wend::test
