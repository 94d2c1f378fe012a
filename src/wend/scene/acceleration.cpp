#include <wend/scene/acceleration.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

namespace wend {
namespace {

/// Of one of the shapes whose crossings are ours to find: all but meshes.
void bound_own_shape(const RTCBoundsFunctionArguments* arguments) {
    const auto& shape = *static_cast<const Shape*>(arguments->geometryUserPtr);
    const auto* curves = std::get_if<CurveSet>(&shape);
    const Box3 box = curves ? bounds(*curves, arguments->primID) : bounds(shape);
    // A flat disk's box must not be empty, nor rounding cut into a sphere.
    const Vec3 margin = box.size() * 1e-5f + Vec3(1e-6f);
    *arguments->bounds_o = {box.min.x - margin.x, box.min.y - margin.y, box.min.z - margin.z, 0,
                            box.max.x + margin.x, box.max.y + margin.y, box.max.z + margin.z, 0};
}

/// Embree refuses, by an assertion, origins and directions beyond 1.844e18 and what is not a number, also in the spaces
/// of instances. The rest of the range is for rounding.
constexpr float embree_reach = 1e18f;

/// The largest coordinate that a map makes of coordinates up to 1.
float largest_image(const Transform& map) {
    double largest = 1;
    for (int row = 0; row < 3; ++row) {
        double sum = 0;
        for (int column = 0; column < 4; ++column) {
            sum += std::abs(map.element(row, column));
        }
        largest = std::max(largest, sum);
    }
    return static_cast<float>(largest);
}

/// Of a mesh at a step of time.
void copy_vertices(RTCGeometry geometry, unsigned step, const std::vector<Vec3>& positions) {
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                             positions.size());
    if (!vertices) {
        throw std::bad_alloc();
    }
    std::copy(positions.begin(), positions.end(), static_cast<Vec3*>(vertices));
}

struct Triangle {
    std::uint32_t corners[3];
};

}  // namespace

SeenInstances::SeenInstances(const std::vector<Instance>& instances) {
    objects.reserve(instances.size());
    ends.reserve(instances.size());
    from_objects.reserve(instances.size());
    for (const Instance& instance : instances) {
        const Motion& motion = instance.world_from_object;
        for (std::size_t i = 0; i < motion.key_count(); ++i) {
            const Transform& world_from_object = motion.key(i);
            Matrix& matrix = from_objects.emplace_back();
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 3; ++row) {
                    matrix[static_cast<std::size_t>(column * 3 + row)] =
                        static_cast<float>(world_from_object.element(row, column));
                }
            }
            largest_inverse = std::max(largest_inverse, largest_image(world_from_object.inverse()));
        }
        objects.push_back(instance.object);
        ends.push_back(from_objects.size());
    }
}

SeenShapes::SeenShapes(const SceneDescription& scene)
    : world(scene.world_surfaces), objects(scene.objects), instances(scene.instances) {
    shapes.reserve(scene.surfaces.size());
    for (const Surface& surface : scene.surfaces) {
        const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
        const bool can_pass = std::holds_alternative<InterfaceMaterial>(material) || surface.alpha >= 0;
        shapes.push_back({surface.shape, can_pass ? Visible::interfaces : Visible::opaque});
    }
}

AccelerationStructure::AccelerationStructure(SeenShapes shapes, const Callbacks& callbacks)
    : shapes_(std::move(shapes)), callbacks_(callbacks), device_(rtcNewDevice("isa=avx2")), reach_(embree_reach) {
    if (!device_) {
        device_.reset(rtcNewDevice("isa=sse4.2"));
    }
    if (!device_) {
        throw std::runtime_error("Embree cannot start on this processor (it needs SSE 4.2)");
    }
    reach_ /= shapes_.instances.largest_inverse;
    for (const ObjectDefinition& object : shapes_.objects) {
        objects_.push_back(new_scene(object.surfaces));
        rtcCommitScene(objects_.back().get());
    }
    scene_ = new_scene(shapes_.world);
    for (std::size_t i = 0; i < shapes_.instances.objects.size(); ++i) {
        add_instance(i);
    }
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree could not build the acceleration structure");
    }
}

AccelerationStructure::SceneHandle AccelerationStructure::new_scene(const std::vector<int>& surfaces) const {
    SceneHandle scene(rtcNewScene(device_.get()));
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (const int surface : surfaces) {
        attach(scene.get(), surface);
    }
    return scene;
}

void AccelerationStructure::add_instance(std::size_t index) {
    const SeenInstances& instances = shapes_.instances;
    const std::size_t first = index == 0 ? 0 : instances.ends[index - 1], end = instances.ends[index];
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, objects_[static_cast<std::size_t>(instances.objects[index])].get());
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(end - first));
    for (std::size_t i = first; i < end; ++i) {
        rtcSetGeometryTransform(geometry, static_cast<unsigned>(i - first), RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                                instances.from_objects[i].data());
    }
    rtcSetGeometryMask(geometry, static_cast<unsigned>(Visible::everything));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(shapes_.shapes.size() + index));
    rtcReleaseGeometry(geometry);
}

RTCGeometry AccelerationStructure::new_mesh(const TriangleMesh& mesh) const {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, mesh.is_moving() ? 2 : 1);
    copy_vertices(geometry, 0, mesh.positions);
    if (mesh.is_moving()) {
        copy_vertices(geometry, 1, mesh.end_positions);
    }
    // Those of the mesh itself, which `shapes_` keeps. Vertices are copies: Embree reads past the last of them.
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               sizeof(Triangle), mesh.triangle_count());
    rtcSetGeometryIntersectFilterFunction(geometry, callbacks_.filter);
    rtcSetGeometryOccludedFilterFunction(geometry, callbacks_.filter);
    return geometry;
}

RTCGeometry AccelerationStructure::new_own_shape(const Shape& shape) const {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
    const auto* curves = std::get_if<CurveSet>(&shape);
    rtcSetGeometryUserPrimitiveCount(geometry, curves ? static_cast<unsigned>(curves->primitive_count()) : 1);
    rtcSetGeometryUserData(geometry, const_cast<Shape*>(&shape));
    rtcSetGeometryBoundsFunction(geometry, bound_own_shape, nullptr);
    rtcSetGeometryIntersectFunction(geometry, callbacks_.intersect);
    rtcSetGeometryOccludedFunction(geometry, callbacks_.occluded);
    return geometry;
}

void AccelerationStructure::attach(RTCScene scene, int surface) const {
    const SeenShapes::Shape& seen = shapes_.shapes[static_cast<std::size_t>(surface)];
    const auto* mesh = std::get_if<TriangleMesh>(seen.shape.get());
    RTCGeometry geometry = mesh ? new_mesh(*mesh) : new_own_shape(*seen.shape);
    rtcSetGeometryMask(geometry, static_cast<unsigned>(seen.seen_by));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(surface));
    rtcReleaseGeometry(geometry);
}

}  // namespace wend
