// The lobes of a guiding field at one or several places, as a page to turn and to read values from.
#pragma once

#include <wend/app/direction_picture.h>
#include <wend/app/field_place.h>
#include <wend/film/false_colour.h>
#include <wend/view/pixel_flight.h>

#include <optional>
#include <string>
#include <vector>

namespace wend {

/// One place on the page.
struct LobePagePlace {
    std::string name;
    FieldPlace place;
    std::vector<DirectionPanel> panels;  ///< the lobes' map, and that of records where there are any
};

/// What the page shows. Texts are plain: the page escapes them.
struct LobePage {
    std::string title;
    std::string file;  ///< of the field
    std::vector<LobePagePlace> places;
    std::optional<PixelFlight> flight;  ///< that the places are on
};

/// By the lobes of all places: what records saw may be brighter.
ColourScale scale_of(const LobePage& page);

/// One HTML page that needs no other file and no network: a sphere of directions that is turned by pointer or keys and
/// says the radiance below the pointer, the flight, and for each place its maps and lobes. Without scripts the sphere
/// is absent and the rest is there. There is at least one place.
std::string lobe_page(const LobePage& page);

}  // namespace wend
