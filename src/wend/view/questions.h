// What the page may ask, and what it is answered.
#pragma once

#include <wend/scene/scene.h>
#include <wend/view/board.h>
#include <wend/view/local_server.h>

#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// What a viewer may do, and with what.
struct ViewOffer {
    std::string title;
    const Scene* scene = nullptr;          ///< null: nothing is known but pictures
    std::vector<ViewCommand::Kind> can;    ///< what the one who renders will do if asked
    std::vector<std::string> samplings{};  ///< names to restart with
};

/// Answers one question: JSON with the key `ask`, and what that wants.
///
/// - `state`: all pictures, how far they are, and what can be done.
/// - `picture` (`of`, `layer`, `have`): bytes: the length of a JSON header in 4 bytes, little-endian, the header (`of`,
///   `layer`, `version`, `width`, `height`, `channels`), then half floats, row by row, channels together. In place of
///   them the text `null` if there is none newer than the version that one has.
/// - `values` (`of`, `x`, `y`): by layer the numbers of a pixel, the key `values`.
/// - `pixel` (`of`, `x`, `y`, perhaps `distance`): pixel_report() as the key `report`.
/// - `pause`, `go_on`, `more_seconds` (`seconds`), `save`, `restart` (`of`, `sampling`), `stop`: an empty object; done
///   soon.
///
/// What cannot be answered has the key `error`.
Reply answer(Board& board, const ViewOffer& offer, std::string_view message);

}  // namespace wend
