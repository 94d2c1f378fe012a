#include <wend/io/pbrt/graphics_state.h>

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

namespace wend::pbrt {
namespace {

constexpr std::size_t deepest_blocks = 10'000;

std::string_view opening(StateStack::Block block) {
    switch (block) {
        case StateStack::Block::attribute:
            return "AttributeBegin";
        case StateStack::Block::object:
            return "ObjectBegin";
        default:
            return "Import";
    }
}

std::string_view closing(StateStack::Block block) {
    switch (block) {
        case StateStack::Block::attribute:
            return "AttributeEnd";
        case StateStack::Block::object:
            return "ObjectEnd";
        default:
            return "the end of the imported file";
    }
}

bool is_finite(const Transform& t) {
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            if (!std::isfinite(t.element(row, column))) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

void GraphicsState::change_transforms(const std::function<Transform(const Transform&)>& change, const Location& place) {
    const auto changed = [&](const Transform& t) -> std::pair<Transform, std::string> {
        try {
            const Transform result = change(t);
            if (is_finite(result) && is_finite(result.inverse())) {
                return {result, ""};
            }
        } catch (const std::domain_error& error) {
            return {t, error.what()};
        }
        return {t, "the transformation matrix or its inverse is no longer finite"};
    };
    const auto replace = [&](Transform& t, std::shared_ptr<const TransformFault>& fault) {
        if (fault) {
            return;
        }
        std::string text;
        std::tie(t, text) = changed(t);
        if (!text.empty()) {
            fault = std::make_shared<const TransformFault>(TransformFault{place, std::move(text)});
        }
    };
    if (active != ActiveTransform::end) {
        replace(ctm.start, ctm.fault);
    }
    if (active != ActiveTransform::start) {
        replace(ctm.end, ctm.fault_at_end);
    }
}

void GraphicsState::set_transforms(const std::function<Transform()>& make, const Location& place) {
    if (active != ActiveTransform::end) {
        ctm.fault.reset();
    }
    if (active != ActiveTransform::start) {
        ctm.fault_at_end.reset();
    }
    change_transforms([&](const Transform&) { return make(); }, place);
}

void StateStack::open(Block block, const Location& place) {
    if (saved_.size() >= deepest_blocks) {
        throw InputError(place, fmt::format("blocks are nested more than {} deep", deepest_blocks));
    }
    saved_.push_back({block, place, current_, {}});
    if (block == Block::import) {
        saved_.back().coordinate_systems = coordinate_systems_;
    }
}

void StateStack::close(Block block, const Location& place) {
    if (saved_.empty()) {
        throw InputError(place, fmt::format("{} without {}", closing(block), opening(block)));
    }
    Saved& last = saved_.back();
    if (last.block != block) {
        throw InputError(place, fmt::format("{}, but the {} at {} is still open", closing(block), opening(last.block),
                                            to_string(Place(last.place))));
    }
    current_ = std::move(last.state);
    if (block == Block::import) {
        coordinate_systems_ = std::move(last.coordinate_systems);
    }
    saved_.pop_back();
}

void StateStack::require_all_closed() const {
    if (!saved_.empty()) {
        throw InputError(saved_.back().place,
                         fmt::format("{} without {}", opening(saved_.back().block), closing(saved_.back().block)));
    }
}

}  // namespace wend::pbrt
