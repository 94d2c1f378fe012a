#include <wend/core/error.h>
#include <wend/subsurface/interior_guide.h>

#include <algorithm>
#include <utility>

namespace wend {

InteriorGuide interior_guide(const HomogeneousMedium& medium, std::vector<std::vector<HalfSpaceMode>> modes,
                             int strategies, float defensive_fraction) {
    const auto require = [](bool condition, const char* rule) {
        if (!condition) {
            throw InputError(std::string("the guide of a medium: ") + rule);
        }
    };
    require(modes.size() == 1 || modes.size() == 3, "the modes must be those of one channel or of three");
    for (const auto& of_channel : modes) {
        require(!of_channel.empty() && of_channel.size() == modes[0].size(), "every channel must have as many modes");
    }
    require(strategies >= 0 && strategies <= InteriorGuide::most_strategies,
            "there are too many strategies, or below 0");
    require(defensive_fraction > 0 && defensive_fraction <= 1, "the classical share must be in (0, 1]");

    InteriorGuide guide;
    guide.medium = medium;
    guide.modes = std::move(modes);
    guide.strategies = strategies;
    if (strategies > 0) {
        std::fill_n(guide.share.begin() + 1, strategies, (1 - defensive_fraction) / static_cast<float>(strategies));
        guide.share[0] = defensive_fraction;
    }
    return guide;
}

}  // namespace wend
