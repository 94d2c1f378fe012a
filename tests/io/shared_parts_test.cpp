#include "load_support.h"

#include <tests/support/scratch_folder.h>
#include <wend/io/load/loaded_parts.h>
#include <wend/io/pbrt/named_parameters.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace wend {
namespace {

const std::string one_square = "\"point3 P\" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] \"integer indices\" [ 0 1 2 0 2 3 ] ";
const std::string hair = "Shape \"curve\" \"point3 P\" [ 0 0 0  0 1 0  0 2 0  0 3 0 ] ";
const std::string world =
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" "
    "MakeNamedMedium \"smoke\" \"string type\" \"uniformgrid\" \"float density\" [ 1 2 3 4 5 6 7 8 ] "
    "\"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 "
    "MakeNamedMaterial \"wax\" \"string type\" \"diffuse\" \"rgb reflectance\" [ .5 .5 .5 ] "
    "MakeNamedMaterial \"air\" \"string type\" \"interface\" NamedMaterial \"wax\" "
    "Shape \"trianglemesh\" " +
    one_square + "Shape \"sphere\" \"float radius\" 2 \"float spoke\" 1 Shape \"cylinder\" " + hair + hair +
    "AttributeBegin MediumInterface \"smoke\" \"\" NamedMaterial \"air\" Shape \"sphere\" \"float radius\" 9 "
    "AttributeEnd "
    "ObjectBegin \"tile\" Shape \"trianglemesh\" " +
    one_square + "ObjectEnd Translate 0 0 5 ObjectInstance \"tile\" ";

/// A scene, and others with some of its parameters changed.
class Shared : public testing::Test {
protected:
    pbrt::Description describe(const std::string& text) const {
        return pbrt::parse_string("WorldBegin " + text, folder_.path(), "test.pbrt");
    }
    LoadedScene load(const pbrt::Description& description) { return load_scene(description, {}, &parts_); }
    /// With what load() left.
    LoadedScene load_again(const pbrt::Description& description) const {
        LoadedParts parts = parts_;
        return load_scene(description, {}, &parts);
    }
    static pbrt::Description changed(pbrt::Description description, const std::string& name, pbrt::ParameterType type,
                                     pbrt::ParameterValues values) {
        pbrt::Parameter parameter;
        parameter.type = type;
        parameter.values = std::move(values);
        pbrt::set_parameter(description, name, std::move(parameter));
        return description;
    }
    static pbrt::Description changed(pbrt::Description description, const std::string& name, float value) {
        return changed(std::move(description), name, pbrt::ParameterType::real, std::vector<float>{value});
    }

    test::ScratchFolder folder_;
    LoadedParts parts_;
};

std::vector<bool> same_shapes(const LoadedScene& a, const LoadedScene& b) {
    std::vector<bool> same;
    for (std::size_t i = 0; i < std::min(a.scene.surfaces.size(), b.scene.surfaces.size()); ++i) {
        same.push_back(a.scene.surfaces[i].shape == b.scene.surfaces[i].shape);
    }
    return same;
}

TEST_F(Shared, WhatChangesDoNotTouch) {
    const pbrt::Description description = describe(world);
    const LoadedScene first = load(description);
    ASSERT_EQ(first.scene.surfaces.size(), 6u);
    const LoadedScene second = load_again(changed(description, "camera.fov", 30));
    EXPECT_EQ(same_shapes(first, second), std::vector<bool>(6, true));
    EXPECT_EQ(&std::get<GridMedium>(first.scene.media[1]).density(),
              &std::get<GridMedium>(second.scene.media[1]).density());
    // Nothing is said less often for being shared.
    EXPECT_EQ(first.warnings, second.warnings);
    EXPECT_EQ(test::warnings_with(second, "spoke"), 1);
    const Scene a(first.scene);
    EXPECT_TRUE(Scene(second.scene, &a).shares_geometry_with(a));
    EXPECT_FALSE(Scene(second.scene).shares_geometry_with(a));
}

TEST_F(Shared, MediaAndMaterialsTouchNoShape) {
    const pbrt::Description description = describe(world);
    const LoadedScene first = load(description);
    const pbrt::Description other = changed(changed(description, "medium.smoke.scale", 2), "material.wax.reflectance",
                                            pbrt::ParameterType::rgb, std::vector<float>{0.1f, 0.2f, 0.3f});
    const LoadedScene second = load_again(other);
    EXPECT_EQ(same_shapes(first, second), std::vector<bool>(6, true));
    EXPECT_EQ(std::get<GridMedium>(second.scene.media[1]).extinction().r,
              2 * std::get<GridMedium>(first.scene.media[1]).extinction().r);
    const Scene a(first.scene);
    EXPECT_TRUE(Scene(second.scene, &a).shares_geometry_with(a));
}

TEST_F(Shared, AShapeThatChangesIsBuiltAlone) {
    const pbrt::Description description = describe(world);
    const LoadedScene first = load(description);
    const LoadedScene second = load_again(changed(description, "shape[1].radius", 3));
    EXPECT_EQ(same_shapes(first, second), (std::vector<bool>{true, false, true, true, true, true}));
    EXPECT_EQ(bounds(*second.scene.surfaces[1].shape).max.x, 3);
    const Scene a(first.scene);
    const Scene b(second.scene, &a);
    EXPECT_FALSE(b.shares_geometry_with(a));
    EXPECT_FLOAT_EQ(b.intersect(Ray{{1.5f, 0.2f, 7}, {0, 0, -1}})->distance, 7 - std::sqrt(9 - 2.29f));
    // A hair is one of many that are a shape.
    EXPECT_EQ(same_shapes(first, load_again(changed(description, "shape[4].width", 0.5f))),
              (std::vector<bool>{true, true, true, false, true, true}));
}

TEST_F(Shared, ShapesThatRaysSeeOtherwiseAreTracedAnew) {
    const pbrt::Description description = describe(world);
    const LoadedScene first = load(description);
    const LoadedScene second = load_again(changed(description, "shape[0].alpha", 0.5f));
    EXPECT_EQ(second.scene.surfaces[0].alpha >= 0, true);
    const Scene a(first.scene);
    EXPECT_FALSE(Scene(second.scene, &a).shares_geometry_with(a));
}

TEST_F(Shared, FilesAreReadOnce) {
    const std::filesystem::path mesh = folder_.write(
        "mesh.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const std::filesystem::path picture = folder_.write("picture.pfm", "PF\n1 1\n-1\n" + std::string(12, '\0'));
    const pbrt::Description description = describe(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"picture.pfm\" "
        "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"plymesh\" \"string filename\" \"mesh.ply\"");
    const LoadedScene first = load(description);
    EXPECT_TRUE(first.kept_files.empty());
    folder_.write("mesh.ply", "changed");
    folder_.write("picture.pfm", "changed");
    const LoadedScene second = load_again(changed(description, "texture.t.scale", 0.5f));
    EXPECT_EQ(second.files, first.files);
    EXPECT_EQ(second.kept_files, (std::set{mesh, picture}));
    EXPECT_EQ(same_shapes(first, second), std::vector{true});
    // What asks for a file by other parameters reads it.
    EXPECT_THROW(load_again(changed(description, "shape[0].spoke", 0.5f)), InputError);
}

}  // namespace
}  // namespace wend
