#include <wend/core/error.h>
#include <wend/subsurface/interior_walk.h>

#include <string>
#include <utility>

namespace wend {

InteriorGuide interior_guide(const HomogeneousMedium& medium, std::vector<std::vector<HalfSpaceMode>> modes,
                             float defensive_fraction) {
    const auto require = [](bool condition, const char* rule) {
        if (!condition) {
            throw InputError(std::string("the guide of a medium: ") + rule);
        }
    };
    require(modes.size() == 1 || modes.size() == 3, "the modes must be those of one channel or of three");
    for (const auto& of_channel : modes) {
        require(!of_channel.empty() && of_channel.size() == modes[0].size(), "every channel must have as many modes");
    }
    require(defensive_fraction > 0 && defensive_fraction <= 1,
            "the probability of classical sampling must be in (0, 1]");
    return {.medium = medium, .modes = std::move(modes), .defensive_fraction = defensive_fraction};
}

}  // namespace wend
