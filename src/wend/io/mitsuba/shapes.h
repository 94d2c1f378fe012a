// Shapes of Mitsuba scenes.
#pragma once

#include <wend/io/mitsuba/materials.h>
#include <wend/io/mitsuba/media.h>

#include <map>

namespace wend::mitsuba {

/// Adds shapes to the scene, with what they are made of, hold and shine by.
class Shapes {
public:
    /// All must outlive this.
    Shapes(Context& context, Materials& materials, Media& media)
        : context_(context), materials_(materials), media_(media) {}

    /// Throws InputError for a shape that there is not; one that Wend lacks is left out, with a warning.
    void add(const Element& shape);

private:
    void add_object(const Object& shape);
    void add_instance(const Object& shape);
    std::string group_name(const Element& group);

    Context& context_;
    Materials& materials_;
    Media& media_;
    std::map<const Element*, std::string> groups_;
    bool in_group_ = false;
    int depth_ = 0;
};

}  // namespace wend::mitsuba
