#include <wend/io/pbrt/name_table.h>

#include <fmt/format.h>

namespace wend::pbrt {

std::size_t NameTable::use(const std::string& name, const Location& place) {
    const auto [entry, is_new] = index_.try_emplace(name, slots_.size());
    if (is_new) {
        slots_.push_back({name, place, false});
    }
    return entry->second;
}

std::size_t NameTable::define(const std::string& name, const Location& place) {
    const std::size_t index = use(name, place);
    Slot& slot = slots_[index];
    if (slot.defined) {
        throw InputError(place, fmt::format("the {} \"{}\" is defined twice; the first is at {}", kind_, name,
                                            to_string(Place(slot.place))));
    }
    slot.place = place;
    slot.defined = true;
    return index;
}

std::size_t NameTable::define_anonymous(const Location& place) {
    slots_.push_back({"", place, true});
    return slots_.size() - 1;
}

void NameTable::require_all_defined() const {
    for (const Slot& slot : slots_) {
        if (!slot.defined) {
            throw InputError(slot.place, fmt::format("the {} \"{}\" is not defined", kind_, slot.name));
        }
    }
}

}  // namespace wend::pbrt
