#include <wend/io/mitsuba/shapes.h>

#include <wend/core/error.h>
#include <wend/core/vector.h>
#include <wend/io/mitsuba/curves.h>
#include <wend/io/mitsuba/emitters.h>
#include <wend/io/mitsuba/meshes.h>

#include <fmt/format.h>

#include <algorithm>

namespace wend::mitsuba {
namespace {

/// Whether a texture is in an object, or in what it refers to.
bool has_texture(const Object& object, int depth = 0) {
    constexpr int deepest = 8;
    if (depth > deepest || !object.nested("texture").empty()) {
        return true;
    }
    const auto has_inner = [&](std::string_view tag) {
        const std::vector<const Element*> inner = object.nested(tag);
        return std::any_of(inner.begin(), inner.end(), [&](const Element* element) {
            return has_texture(Object(object.context(), *element), depth + 1);
        });
    };
    return has_inner("bsdf") || has_inner("emitter");
}

/// Disks with textures are: their texture coordinates are others than those of a disk of pbrt.
bool is_mesh(const Object& shape) {
    return shape.is_one_of({"cube", "obj", "ply", "rectangle", "serialized"}) ||
           (shape.type() == "disk" && has_texture(shape));
}

bool is_curve(const Object& shape) {
    return shape.is_one_of({"bsplinecurve", "linearcurve"});
}

/// Of the map from the unit sphere, disk or cylinder, whose axis is z.
struct Quadric {
    std::string type;
    Transform to_world;
};

Transform translate(const Vec3& by) {
    return Transform::translate(by.x, by.y, by.z);
}

Quadric sphere_of(const Object& shape, Parameters& p) {
    p.real("radius", shape.positive("radius", 1));
    const Vec3 center = shape.vector("center").value_or(Vec3(0, 0, 0));
    // v = 0 is at the top, where pbrt's is 1.
    return {"sphere", shape.transform("to_world") * translate(center) * Transform::scale(1, 1, -1)};
}

/// Mitsuba finds the picture of a ball that is turned where it were if it was not, and weighs it so.
void warn_of_turned_lamp(const Object& sphere, const Element& emitter) {
    const Transform to_world = sphere.transform("to_world");
    const Vec3 x = to_world.vector({1, 0, 0}), z = to_world.vector({0, 0, 1});
    constexpr float straight = 1e-4f;
    if (x.x >= (1 - straight) * length(x) && z.z >= (1 - straight) * length(z)) {
        return;
    }
    if (!Object(sphere.context(), emitter).nested("texture").empty()) {
        sphere.context().warn(emitter.place,
                              "the picture of a turned sphere lights as it is seen: where Mitsuba samples it, it is "
                              "not turned");
    }
}

Quadric cylinder_of(const Object& shape, Parameters& p) {
    const Vec3 p0 = shape.vector("p0").value_or(Vec3(0, 0, 0)), p1 = shape.vector("p1").value_or(Vec3(0, 0, 1));
    const float height = length(p1 - p0);
    if (!(height > 0)) {
        throw InputError(shape.place_of("p1"), "the ends of a cylinder, \"p0\" and \"p1\", must differ");
    }
    p.real("radius", shape.positive("radius", 1)).real("zmin", 0).real("zmax", height);
    const Frame frame = Frame::from_z((p1 - p0) / height);
    const Transform::Matrix turned = {{frame.s.x, frame.t.x, frame.n.x, p0.x},
                                      {frame.s.y, frame.t.y, frame.n.y, p0.y},
                                      {frame.s.z, frame.t.z, frame.n.z, p0.z},
                                      {0, 0, 0, 1}};
    return {"cylinder", shape.transform("to_world") * Transform(turned)};
}

Quadric quadric_of(const Object& shape, Parameters& p) {
    return shape.type() == "sphere"     ? sphere_of(shape, p)
           : shape.type() == "cylinder" ? cylinder_of(shape, p)
                                        : Quadric{"disk", shape.transform("to_world")};
}

/// Whether a shape of pbrt's is to be reversed. pbrt turns normals where a transform mirrors, and has those of curves
/// inside; Mitsuba's stay outside, but for those of a sphere, whose radius is below 0 then.
bool is_turned(const Object& shape, const Transform& to_world) {
    const bool is_inside_out = shape.type() == "sphere" && shape.transform("to_world").swaps_handedness();
    const bool is_flipped = shape.flag("flip_normals", false) != is_inside_out;
    return is_curve(shape) || is_flipped != to_world.swaps_handedness();
}

/// Null for curves, too: they never shine.
const Element* emitter_of(const Object& shape) {
    const Element* emitter = shape.nested_one("emitter");
    if (emitter && is_curve(shape)) {
        shape.context().warn(emitter->place, fmt::format("{} does not shine: it is dark", shape.title()));
        return nullptr;
    }
    if (emitter && shape.type() == "sphere") {
        warn_of_turned_lamp(shape, *emitter);
    }
    return emitter;
}

}  // namespace

void Shapes::add(const Element& element) {
    constexpr int deepest = 32;
    if (depth_ >= deepest) {
        throw InputError(element.place, "shapes are merged of each other, too deeply or in a circle");
    }
    ++depth_;
    const Object shape(context_, element);
    const std::string_view type = shape.type();
    if (is_mesh(shape) || is_curve(shape) || shape.is_one_of({"cylinder", "disk", "sphere"})) {
        add_object(shape);
    } else if (type == "instance") {
        add_instance(shape);
    } else if (type == "shapegroup") {
        static_cast<void>(group_name(element));
    } else if (type == "merge") {
        for (const Element* inner : shape.nested("shape")) {
            add(*inner);
        }
    } else if (shape.is_one_of({"ellipsoids", "ellipsoidsmesh", "sdfgrid"})) {
        context_.warn(shape.place(), fmt::format("{} is not implemented: it is left out", shape.title()));
        --depth_;
        return;
    } else {
        refuse_type(
            shape,
            "bsplinecurve, cube, cylinder, disk, instance, linearcurve, merge, obj, ply, rectangle, serialized, "
            "shapegroup, sphere");
    }
    shape.warn_of_unused();
    --depth_;
}

void Shapes::add_object(const Object& shape) {
    Parameters p(shape.place());
    Transform to_world;
    std::string type = "trianglemesh";
    TriangleMeshData mesh;
    if (is_mesh(shape)) {
        mesh = mesh_of(shape);
        if (mesh.indices.empty()) {
            context_.warn(shape.place(), fmt::format("{} has no triangles: it is left out", shape.title()));
            return;
        }
        set_mesh(mesh, p);
    } else if (is_curve(shape)) {
        type = "curve";
    } else {
        Quadric quadric = quadric_of(shape, p);
        type = std::move(quadric.type);
        to_world = quadric.to_world;
    }
    const Element* emitter = emitter_of(shape);
    const SurfaceLook look = materials_.look_of(shape.nested_one("bsdf"), shape.place(), emitter != nullptr, &mesh);
    if (shape.element().has("id")) {
        p.text("name", std::string(shape.element().attribute("id")));
    }
    if (look.alpha) {
        p.real("alpha", *look.alpha);
    }
    const auto medium = [&](std::string_view name) {
        const Element* element = shape.find(name);
        if (element && element->tag != "medium") {
            throw InputError(element->place,
                             fmt::format("\"{}\" of {} is a <medium>, not a <{}>", name, shape.title(), element->tag));
        }
        return element ? media_.name_of(*element) : std::string();
    };
    const std::string interior = medium("interior"), exterior = medium("exterior");
    const bool has_turned_normals = is_turned(shape, to_world);
    shape.ignore("silhouette_sampling_weight");
    std::vector<pbrt::ParameterSet> pieces{p.take()};
    if (is_curve(shape)) {
        pieces = curves_of(shape, pieces.front());
    }
    in_block(context_, to_world, shape.place(), [&] {
        pbrt::DescriptionBuilder& builder = context_.builder;
        builder.named_material(look.material, shape.place());
        builder.medium_interface(interior, exterior, shape.place());
        if (emitter) {
            add_area_emitter(context_, *emitter);
        }
        if (has_turned_normals) {
            builder.reverse_orientation(shape.place());
        }
        for (pbrt::ParameterSet& piece : pieces) {
            builder.shape(type, std::move(piece), shape.place());
        }
    });
}

std::string Shapes::group_name(const Element& element) {
    if (in_group_) {
        throw InputError(element.place, "a \"shapegroup\" cannot be in another one");
    }
    const auto [known, is_new] = groups_.try_emplace(&element);
    if (!is_new) {
        return known->second;
    }
    const Object group(context_, element);
    known->second = context_.new_name();
    const std::string name = known->second;
    in_group_ = true;
    context_.builder.object_begin(name, group.place());
    for (const Element* shape : group.nested("shape")) {
        add(*shape);
    }
    context_.builder.object_end(group.place());
    in_group_ = false;
    group.warn_of_unused();
    return name;
}

void Shapes::add_instance(const Object& shape) {
    if (in_group_) {
        throw InputError(shape.place(), "an \"instance\" cannot be in a \"shapegroup\"");
    }
    const Element* group = shape.nested_one("shape");
    if (!group || group->attribute("type") != "shapegroup") {
        throw InputError(shape.place(), "an \"instance\" needs a <shape type=\"shapegroup\">");
    }
    const std::string name = group_name(*group);
    in_block(context_, shape.transform("to_world"), shape.place(),
             [&] { context_.builder.object_instance(name, shape.place()); });
}

}  // namespace wend::mitsuba
