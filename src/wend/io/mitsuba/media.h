// Media of Mitsuba scenes.
#pragma once

#include <wend/io/mitsuba/object.h>

#include <string>
#include <unordered_map>

namespace wend::mitsuba {

/// Adds media to the scene when they are first asked for.
class Media {
public:
    /// The context must outlive this.
    explicit Media(Context& context) : context_(context) {}

    /// The name of the medium that an element describes. Throws InputError for one that there is not.
    std::string name_of(const Element& medium);

private:
    Context& context_;
    std::unordered_map<const Element*, std::string> names_;
};

}  // namespace wend::mitsuba
