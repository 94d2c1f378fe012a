// What the vertices or faces of a PLY file have beside a mesh's shape, by the names that Mitsuba gives it.
#pragma once

#include <wend/io/ply.h>
#include <wend/io/ply_header.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace wend::ply {

/// Which properties of an element are the channels of an attribute.
struct AttributeFields {
    std::string name;                 ///< "vertex_color" of r, g, b; "vertex_heat" of heat_0; "face_dye_color" ...
    std::vector<std::size_t> fields;  ///< one or three
    float scale = 1;                  ///< of their numbers: colours of bytes go up to 255
};

/// One or three numbers whose names end on _x _y _z, _r _g _b, _0 _1 _2 or _1 _2 _3, or that are called r, g, b or red,
/// green, blue. `prefix`: "vertex_" or "face_".
std::vector<AttributeFields> attributes_of(const Element& element, std::string_view prefix);

/// Takes the values of an element's properties, one after the other, as its attributes.
class AttributeRows {
public:
    AttributeRows(const Element& element, std::string_view prefix);

    bool is_empty() const { return attributes_.empty(); }
    void set(std::size_t property, double value) { row_[property] = static_cast<float>(value); }
    /// Adds the row to all attributes.
    void add_row();
    std::vector<MeshAttribute> take() { return std::move(attributes_); }

private:
    std::vector<AttributeFields> fields_;
    std::vector<float> row_;
    std::vector<MeshAttribute> attributes_;
};

}  // namespace wend::ply
