// Pictures of the whole sky in the mapping that lights have.
#pragma once

#include <wend/core/image.h>

namespace wend {

/// Where the rows of a picture of the sky are.
enum class SkyRows {
    in_strips,  ///< each is the middle of a strip, all as wide
    on_nodes    ///< the first and the last are the poles
};

/// The square picture of a sphere by the equal-area octahedral mapping, of one by longitude and latitude: there the
/// first row is around +z, the middle of a row is towards +x, and +y is to the left of it. Its pixels are means, and
/// about as fine as those in the middle of the given one, from 1024 x 1024 to 4096 x 4096.
Image equal_area_sky(const Image& by_longitude, SkyRows rows);

}  // namespace wend
