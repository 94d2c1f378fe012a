// How far from the origin things may be.
#pragma once

#include <wend/core/transform.h>
#include <wend/io/load/context.h>
#include <wend/scene/shape.h>

#include <string_view>

namespace wend {

/// Beyond this, products of coordinates leave the range of floats, and rays that of Embree.
inline constexpr float farthest = 1e9f;

/// Throws InputError at the place unless the point is finite and no coordinate of it is beyond `farthest`. `what`
/// begins the message: "Camera" stands at ... Spheres and disks may reach further.
void require_near(const Place& place, std::string_view what, const Vec3& point);

/// The same for all of a shape; returns what it takes up.
Box3 require_near(const Place& place, std::string_view what, const Shape& shape);

/// The same for an object that fills the box where it is put, and for the rays that are taken into its space: it must
/// not be too small.
void require_near(const Place& place, const Box3& object, const Transform& world_from_object);

}  // namespace wend
