// A pbrt-v4 scene as written, with everything that depends on the order of the file worked out: no scene objects yet.
#pragma once

#include <wend/core/motion.h>
#include <wend/io/pbrt/parameters.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace wend::pbrt {

/// What one directive asks for: `Film "rgb" ...` has the type "rgb".
struct Entity {
    std::string type;
    ParameterSet parameters;
    Location place;
};

struct CameraEntity : Entity {
    Motion world_from_camera;
    std::optional<std::size_t> medium;  ///< index in Description::media; none: vacuum
};

/// Material and MakeNamedMaterial.
struct MaterialEntity : Entity {
    std::string name;  ///< empty for an anonymous one
};

enum class TextureKind { real, spectrum };

struct TextureEntity : Entity {
    std::string name;
    TextureKind kind = TextureKind::real;
    Transform world_from_texture;
};

struct MediumEntity : Entity {
    std::string name;
    Transform world_from_medium;
};

struct LightEntity : Entity {
    Transform world_from_light;
    std::optional<std::size_t> medium;  ///< what the light shines in
};

struct ShapeEntity : Entity {
    Transform world_from_object;
    /// What moves it then: shapes that follow each other and move together have the same one. Null for one at rest.
    std::shared_ptr<const Motion> motion;
    bool reverse_orientation = false;
    std::size_t material = 0;
    std::optional<std::size_t> interior;    ///< index in Description::media
    std::optional<std::size_t> exterior;    ///< index in Description::media
    std::optional<std::size_t> area_light;  ///< index in Description::area_lights
    std::optional<std::size_t>
        object;  ///< index in Description::objects: not in the scene itself, but in its instances
};

/// ObjectBegin ... ObjectEnd: the shapes that point here.
struct ObjectDefinition {
    std::string name;
    Location place;
};

/// A copy of an object: its shapes are at `world_from_instance * shape.motion * shape.world_from_object`.
struct ObjectInstance {
    std::size_t object = 0;
    Motion world_from_instance;
    Location place;
};

/// When what moves is at its start and at its end.
struct TransformTimes {
    float start = 0, end = 1;
};

/// All indices are valid and every texture that a parameter names exists.
struct Description {
    std::filesystem::path base_directory;
    std::vector<std::filesystem::path> files;  ///< that were parsed; none if the text is no file
    bool is_for_pbrt = false;  ///< whether it is a text as pbrt reads them, and not made of what another program has

    // Directives that a file need not have start with the types that pbrt takes then.
    CameraEntity camera{{"perspective", {}, {}}, {}, {}};
    TransformTimes transform_times;
    Entity film{"rgb", {}, {}};
    Entity filter{"gaussian", {}, {}};
    Entity sampler{"zsobol", {}, {}};
    Entity integrator{"volpath", {}, {}};
    Entity accelerator{"bvh", {}, {}};
    ParameterSet options;

    std::vector<MaterialEntity> materials{
        {{"diffuse", {}, {}}, ""}};  ///< the first is that of shapes before any Material
    std::vector<TextureEntity> textures;
    std::vector<MediumEntity> media;
    std::vector<LightEntity> lights;
    std::vector<Entity> area_lights;
    std::vector<ShapeEntity> shapes;
    std::vector<ObjectDefinition> objects;
    std::vector<ObjectInstance> instances;

    /// What was understood but is not done as asked, as `file:line:column: warning: ...`, each kind once.
    std::vector<std::string> warnings;
};

}  // namespace wend::pbrt
