// What arrives at a place, by direction, as a picture with axes.
#pragma once

#include <wend/app/direction_map.h>
#include <wend/film/false_colour.h>

#include <string>
#include <vector>

namespace wend {

/// One map of the picture.
struct DirectionPanel {
    std::string title;          ///< ASCII
    std::vector<float> values;  ///< as in DirectionMap
    std::vector<Vec3> marks;    ///< directions that get a cross, such as means of lobes
};

/// Four decades below the largest value of all panels, logarithmic.
ColourScale scale_of(const std::vector<DirectionPanel>& panels);

/// The map in false colours, a cross at each mark, without axes.
Image map_image(const DirectionPanel& panel, const ColourScale& scale);

/// All panels below each other, each with its title, axes that name angles (degrees) and the directions of the world's
/// axes, and the colours with the radiances that they stand for, in the scene's unit. The scale is logarithmic, over
/// four decades.
Picture labelled_picture(const std::vector<DirectionPanel>& panels, const ColourScale& scale);

}  // namespace wend
