// Embree's structures over shapes. They know nothing of what the shapes are made of, so that scenes may have them
// together.
#pragma once

#include <wend/scene/embree.h>
#include <wend/scene/scene.h>

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace wend {

/// Which surfaces a ray sees.
enum class Visible : unsigned { opaque = 1, interfaces = 2, everything = 3 };

/// Where objects are placed, as Embree has it: a scene may have very many, and its own transforms are larger.
struct SeenInstances {
    /// The upper three rows, column by column.
    using Matrix = std::array<float, 12>;

    SeenInstances() = default;
    explicit SeenInstances(const std::vector<Instance>& instances);

    std::vector<int> objects;          ///< by instance
    std::vector<std::size_t> ends;     ///< by instance: where its matrices end
    std::vector<Matrix> from_objects;  ///< of one instance after the other, at its steps of time
    float largest_inverse = 1;  ///< the largest coordinate that a way into an object makes of coordinates up to 1

    friend bool operator==(const SeenInstances&, const SeenInstances&) = default;
};

/// What of a scene an acceleration structure depends on. Copies share the shapes.
struct SeenShapes {
    struct Shape {
        SharedShape shape;
        Visible seen_by;

        friend bool operator==(const Shape&, const Shape&) = default;
    };

    explicit SeenShapes(const SceneDescription& scene);

    std::vector<Shape> shapes;  ///< by surface
    std::vector<int> world;     ///< surfaces that are in no object
    std::vector<ObjectDefinition> objects;
    SeenInstances instances;

    /// Whether the shapes are the same ones, and not just alike, seen and placed alike.
    friend bool operator==(const SeenShapes&, const SeenShapes&) = default;
};

/// Built once; any number of threads may send rays through it. Its instruction set is pinned, so that the same rays hit
/// the same points on every machine. A surface has the id that it has in its scene; instances follow behind those.
class AccelerationStructure {
public:
    /// What Embree calls for each candidate, with a query's context.
    struct Callbacks {
        RTCFilterFunctionN filter;  ///< of triangles
        RTCIntersectFunctionN intersect;
        RTCOccludedFunctionN occluded;
    };

    /// Throws std::runtime_error where Embree cannot build it.
    AccelerationStructure(SeenShapes shapes, const Callbacks& callbacks);

    bool is_of(const SeenShapes& shapes) const { return shapes_ == shapes; }
    RTCScene scene() const { return scene_.get(); }
    /// The largest coordinate of a ray's origin and direction.
    float reach() const { return reach_; }

private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
    using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

    SceneHandle new_scene(const std::vector<int>& surfaces) const;
    RTCGeometry new_mesh(const TriangleMesh& mesh) const;
    RTCGeometry new_own_shape(const Shape& shape) const;
    void attach(RTCScene scene, int surface) const;
    void add_instance(std::size_t index);

    SeenShapes shapes_;
    Callbacks callbacks_;
    Device device_;
    std::vector<SceneHandle> objects_;
    SceneHandle scene_;
    float reach_;
};

}  // namespace wend
