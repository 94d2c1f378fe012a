#include <tests/io/near.h>
#include <tests/io/pbrt_support.h>
#include <wend/io/pbrt/parser.h>

#include <gtest/gtest.h>

#include <string>

namespace wend::pbrt {
namespace {

using test::expect_near;

std::string error_of(const std::string& text) {
    return message_of([&] { parse(text); });
}

std::string world_error_of(const std::string& text) {
    return error_of("WorldBegin\n" + text);
}

TEST(PbrtParser, OptionsBeforeTheWorld) {
    const Description d = parse(
        "Camera \"spherical\" \"float lensradius\" 1\nFilm \"gbuffer\"\nPixelFilter \"box\"\nSampler \"halton\"\n"
        "Integrator \"bdpt\"\nAccelerator \"kdtree\"\nOption \"disablepixeljitter\" true\nOption \"string "
        "rendercoordsys\" "
        "\"world\"\nOption \"seed\" 7\nOption \"displacementedgescale\" 1.5 Option \"msereferenceimage\" "
        "\"a.exr\"\nWorldBegin");
    EXPECT_EQ(d.camera.type, "spherical");
    EXPECT_EQ(d.camera.parameters.get_float("lensradius", 0), 1);
    EXPECT_EQ(d.film.type, "gbuffer");
    EXPECT_EQ(d.film.place.line, 2);
    EXPECT_EQ(d.filter.type, "box");
    EXPECT_EQ(d.sampler.type, "halton");
    EXPECT_EQ(d.integrator.type, "bdpt");
    EXPECT_EQ(d.accelerator.type, "kdtree");
    EXPECT_TRUE(d.options.get_bool("disablepixeljitter", false));
    EXPECT_EQ(d.options.get_string("rendercoordsys", ""), "world");
    EXPECT_EQ(d.options.get_int("seed", 0), 7);
    EXPECT_EQ(d.options.get_float("displacementedgescale", 0), 1.5f);
    EXPECT_EQ(d.options.get_string("msereferenceimage", ""), "a.exr");
    EXPECT_TRUE(d.warnings.empty());
}

TEST(PbrtParser, AnEmptyWorldHasPbrtsDefaults) {
    const Description d = parse("WorldBegin");
    EXPECT_EQ(d.camera.type, "perspective");
    EXPECT_EQ(d.film.type, "rgb");
    EXPECT_EQ(d.filter.type, "gaussian");
    EXPECT_EQ(d.sampler.type, "zsobol");
    EXPECT_EQ(d.integrator.type, "volpath");
    ASSERT_EQ(d.materials.size(), 1u);
    EXPECT_EQ(d.materials[0].type, "diffuse");
}

TEST(PbrtParser, CameraTransformIsTheCurrentOne) {
    const Description d =
        parse("Scale -1 1 1 LookAt 1 2 3  4 2 3  0 1 0 Camera \"perspective\" WorldBegin Shape \"sphere\"");
    expect_near(d.camera.world_from_camera.start().inverse().point(Vec3(4, 2, 3)), Vec3(0, 0, 3));
    const Vec3 beside = Transform::look_at({1, 2, 3}, {4, 2, 3}, {0, 1, 0}).point(Vec3(4, 2, 4));
    expect_near(d.camera.world_from_camera.start().inverse().point(Vec3(4, 2, 4)), Vec3(-beside.x, beside.y, beside.z));
    EXPECT_EQ(d.shapes[0].world_from_object, Transform());
}

TEST(PbrtParser, TransformsApplyInTheOrderOfTheFileFromTheOutside) {
    const Description d = parse_world(
        "Translate 1 2 3 Scale 2 2 2 Shape \"a\" Rotate 90 0 0 1 Shape \"b\"\nIdentity Shape \"c\"\n"
        "Transform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1] Shape \"d\"\n"
        "ConcatTransform [0 1 0 0  -1 0 0 0  0 0 1 0  1 0 0 1] Shape \"e\"");
    expect_near(d.shapes[0].world_from_object.point(Vec3(1, 0, 0)), Vec3(3, 2, 3));
    expect_near(d.shapes[1].world_from_object.point(Vec3(1, 0, 0)), Vec3(1, 4, 3));
    expect_near(d.shapes[2].world_from_object.point(Vec3(1, 0, 0)), Vec3(1, 0, 0));
    expect_near(d.shapes[3].world_from_object.point(Vec3(0, 0, 0)), Vec3(5, 6, 7));
    expect_near(d.shapes[4].world_from_object.point(Vec3(1, 0, 0)), Vec3(6, 7, 7));
}

TEST(PbrtParser, CoordinateSystems) {
    const Description d = parse(
        "Translate 0 0 5 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" Shape \"a\" Translate 1 0 0 "
        "CoordinateSystem \"mine\" CoordSysTransform \"world\" Shape \"b\" CoordSysTransform \"mine\" Shape \"c\"");
    expect_near(d.shapes[0].world_from_object.point(Vec3(0)), Vec3(0, 0, -5));
    expect_near(d.shapes[1].world_from_object.point(Vec3(0)), Vec3(0, 0, 0));
    expect_near(d.shapes[2].world_from_object.point(Vec3(0)), Vec3(1, 0, -5));
    const Description unknown = parse_world("Translate 1 2 3 CoordSysTransform \"nowhere\" Shape \"a\"");
    expect_near(unknown.shapes[0].world_from_object.point(Vec3(0)), Vec3(1, 2, 3));
    ASSERT_EQ(unknown.warnings.size(), 1u);
    EXPECT_PRED2(contains, unknown.warnings[0], "warning: the coordinate system \"nowhere\" is not defined");
}

TEST(PbrtParser, ShapesAndInstancesMoveFromTheStartToTheEnd) {
    const Description d = parse_world(
        "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 2 0 0\n"
        "ActiveTransform All Translate 0 1 0 Shape \"a\"\nShape \"b\" Translate 0 0 1 Shape \"c\"\n"
        "ObjectBegin \"o\" ObjectEnd ObjectInstance \"o\" Identity Shape \"d\" ObjectInstance \"o\"");
    EXPECT_EQ(d.warnings.size(), 0u);
    ASSERT_TRUE(d.shapes[0].motion);
    expect_near(d.shapes[0].world_from_object.point(Vec3(0)), Vec3(0, 0, 0));
    expect_near(d.shapes[0].motion->at(0).world_from_object.point(Vec3(0)), Vec3(1, 1, 0));
    expect_near(d.shapes[0].motion->at(1).world_from_object.point(Vec3(0)), Vec3(2, 1, 0));
    EXPECT_EQ(d.shapes[1].motion, d.shapes[0].motion);
    EXPECT_NE(d.shapes[2].motion, d.shapes[0].motion);
    EXPECT_FALSE(d.shapes[3].motion);
    EXPECT_TRUE(d.instances[0].world_from_instance.is_moving());
    EXPECT_FALSE(d.instances[1].world_from_instance.is_moving());
}

TEST(PbrtParser, TheCameraMovesTheOtherWay) {
    const Description d = parse_string(
        "TransformTimes 1 3 ActiveTransform EndTime Translate 2 0 0 Camera \"perspective\" WorldBegin", ".", "t.pbrt");
    EXPECT_EQ(d.warnings.size(), 0u);
    expect_near(d.camera.world_from_camera.at(0).world_from_object.point(Vec3(0)), Vec3(0, 0, 0));
    expect_near(d.camera.world_from_camera.at(1).world_from_object.point(Vec3(0)), Vec3(-2, 0, 0));
    EXPECT_EQ(d.transform_times.start, 1);
    EXPECT_EQ(d.transform_times.end, 3);
}

TEST(PbrtParser, LightsMediaAndTexturesStayAtTheStart) {
    const Description d = parse_world(
        "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 2 0 0\n"
        "LightSource \"point\"\nLightSource \"point\"");
    expect_near(d.lights[0].world_from_light.point(Vec3(0)), Vec3(1, 0, 0));
    ASSERT_EQ(d.warnings.size(), 1u);
    EXPECT_PRED2(contains, d.warnings[0], "t.pbrt:3:1: warning: lights, media and textures do not move");
}

TEST(PbrtParser, AreaLightsMoveWithTheirShapes) {
    const Description d = parse_world(
        "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 2 0 0\n"
        "AttributeBegin AreaLightSource \"diffuse\" Shape \"a\" AttributeEnd");
    ASSERT_TRUE(d.shapes[0].area_light && d.shapes[0].motion);
    expect_near(d.shapes[0].motion->at(1).world_from_object.point(Vec3(0)), Vec3(2, 0, 0));
    EXPECT_EQ(d.warnings.size(), 0u);
}

TEST(PbrtParser, WhatMirrorsAtOneEndOnlyStaysAtTheStart) {
    const Description d = parse_world("ActiveTransform EndTime\nScale -1 1 1\nShape \"a\" Identity Shape \"b\"");
    EXPECT_FALSE(d.shapes[0].motion);
    ASSERT_EQ(d.warnings.size(), 1u);
    EXPECT_PRED2(contains, d.warnings[0], "t.pbrt:4:1: warning: of the transformations at the start and the end");
}

TEST(PbrtParser, WithoutATransformAtTheEndItIsLeftOutToo) {
    const Description d =
        parse_world("ActiveTransform EndTime\nScale 0 1 1\nShape \"a\" LightSource \"point\" Identity Shape \"b\"");
    ASSERT_EQ(d.shapes.size(), 1u);
    EXPECT_EQ(d.shapes[0].type, "b");
    EXPECT_EQ(d.lights.size(), 1u);
    ASSERT_EQ(d.warnings.size(), 1u);
    EXPECT_PRED2(contains, d.warnings[0], "t.pbrt:3:1: warning: Shape \"a\" is left out: a scale");
}

TEST(PbrtParser, WhatHasNoTransformIsLeftOut) {
    const char* const faults[][2] = {
        {"  Scale 0 1 1", "t.pbrt:3:3: warning: Shape \"a\" is left out: a scale"},
        {"Rotate 10 0 0 0", "t.pbrt:3:1: warning: Shape \"a\" is left out: a rotation"},
        {"LookAt 0 0 0 0 0 0 0 1 0", "t.pbrt:3:1: warning: Shape \"a\" is left out: the up vector"},
        {"Transform [1 0 0 0 2 0 0 0 0 0 1 0 0 0 0 1]", "singular"},
        {"ConcatTransform [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]", "singular"},
        {"Scale 1e100 1 1 Scale 1e100 1 1 Scale 1e100 1 1 Scale 1e100 1 1",
         "t.pbrt:3:49: warning: Shape \"a\" is left out: the transformation matrix or its inverse is no longer "
         "finite"}};
    for (const auto& [fault, warning] : faults) {
        const Description d = parse_world(std::string("ObjectBegin \"o\" ObjectEnd AttributeBegin\n") + fault +
                                          " Translate 1 2 3 Shape \"a\" LightSource \"l\" ObjectInstance \"o\" "
                                          "Identity Shape \"b\" AttributeEnd Shape \"c\"");
        ASSERT_EQ(d.shapes.size(), 2u) << fault;
        EXPECT_EQ(d.shapes[0].type, "b");
        EXPECT_EQ(d.shapes[1].type, "c");
        EXPECT_TRUE(d.lights.empty());
        EXPECT_TRUE(d.instances.empty());
        ASSERT_EQ(d.warnings.size(), 3u) << fault;
        EXPECT_PRED2(contains, d.warnings[0], warning);
    }
}

TEST(PbrtParser, UnusedFaultyTransformsDoNotMatter) {
    const Description d = parse_world(
        "AttributeBegin Scale 1 1 0 CoordinateSystem \"flat\" AttributeBegin AttributeEnd AttributeEnd\n"
        "Shape \"a\" CoordSysTransform \"flat\" Translate 1 0 0 CoordSysTransform \"world\" Shape \"b\"");
    EXPECT_TRUE(d.warnings.empty());
    EXPECT_EQ(d.shapes.size(), 2u);
    EXPECT_EQ(error_of("Scale 0 1 1\nCamera \"perspective\"\nWorldBegin"),
              "t.pbrt:1:1: error: a scale must be finite and not zero");
}

TEST(PbrtParser, MalformedTransformsAreErrors) {
    EXPECT_PRED2(contains, world_error_of("Transform [1 2 3]"), "expected a number, found ']'");
    EXPECT_PRED2(contains, world_error_of("Transform 1 2 3"), "expected '[', found \"1\"");
    EXPECT_PRED2(contains, world_error_of("Translate 1 2"), "expected a number, found the end of the file");
    EXPECT_PRED2(contains, error_of("TransformTimes 2 1"), "t.pbrt:1:1: error: the end time is before");
    EXPECT_PRED2(contains, world_error_of("TransformTimes 0 1"), "TransformTimes is not allowed after WorldBegin");
    EXPECT_PRED2(contains, world_error_of("ActiveTransform Middle"), "t.pbrt:2:17: error: expected StartTime");
}

TEST(PbrtParser, MaterialsAnonymousNamedAndUsedBeforeTheirDefinition) {
    const Description d = parse_world(
        "Shape \"a\" Material \"conductor\" \"float roughness\" .1 Shape \"b\" NamedMaterial \"late\" Shape \"c\"\n"
        "Material \"interface\" Shape \"d\" MakeNamedMaterial \"late\" \"string type\" \"dielectric\" Shape \"e\"");
    const auto material = [&](std::size_t shape) { return d.materials[d.shapes[shape].material]; };
    EXPECT_EQ(material(0).type, "diffuse");
    EXPECT_EQ(material(1).type, "conductor");
    EXPECT_EQ(material(2).type, "dielectric");
    EXPECT_EQ(material(2).name, "late");
    EXPECT_EQ(material(3).type, "interface");
    EXPECT_EQ(material(4).type, "interface");
    EXPECT_EQ(material(1).parameters.get_float("roughness", 0), .1f);
}

TEST(PbrtParser, AttributeBlocksRestoreEverything) {
    const Description d = parse_world(
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\nAttributeBegin Translate 1 0 0 Material \"conductor\" "
        "MediumInterface \"m\" \"\" AreaLightSource \"diffuse\" ReverseOrientation ColorSpace \"rec2020\" Attribute "
        "\"shape\" \"float radius\" 2 Shape \"a\" AttributeEnd Shape \"b\" \"rgb c\" [1 1 1]");
    const ShapeEntity& inner = d.shapes[0];
    expect_near(inner.world_from_object.point(Vec3(0)), Vec3(1, 0, 0));
    EXPECT_TRUE(inner.reverse_orientation);
    EXPECT_EQ(inner.interior, 0u);
    EXPECT_FALSE(inner.exterior);
    EXPECT_EQ(inner.area_light, 0u);
    EXPECT_EQ(d.area_lights[0].type, "diffuse");
    EXPECT_EQ(inner.parameters.get_float("radius", 0), 2);
    const ShapeEntity& outer = d.shapes[1];
    EXPECT_EQ(outer.world_from_object, Transform());
    EXPECT_FALSE(outer.reverse_orientation || outer.interior || outer.exterior || outer.area_light);
    EXPECT_EQ(outer.material, 0u);
    EXPECT_FALSE(outer.parameters.has("radius"));
    EXPECT_EQ(std::get<RgbColour>(*outer.parameters.get_colour("c")).space, ColourSpace::srgb);
}

TEST(PbrtParser, AttributeDefaultsReachTheirTargetsAndYieldToOwnParameters) {
    const Description d = parse_world(
        "Attribute \"shape\" \"float a\" 1 \"float b\" 2 Attribute \"shape\" \"float b\" 3\n"
        "Attribute \"light\" \"float scale\" 4 Attribute \"material\" \"float roughness\" 5\n"
        "Attribute \"medium\" \"float g\" 6 Attribute \"texture\" \"float value\" 7\n"
        "Shape \"s\" Shape \"s\" \"float a\" 9\nLightSource \"point\" AreaLightSource \"diffuse\" Material \"x\"\n"
        "MakeNamedMaterial \"n\" \"string type\" \"y\" MakeNamedMedium \"m\" \"string type\" \"z\"\n"
        "Texture \"t\" \"float\" \"constant\"");
    EXPECT_EQ(d.shapes[0].parameters.get_float("a", 0), 1);
    EXPECT_EQ(d.shapes[0].parameters.get_float("b", 0), 3);
    EXPECT_EQ(d.shapes[1].parameters.get_float("a", 0), 9);
    EXPECT_TRUE(d.shapes[1].parameters.unused().empty()) << "defaults that nobody asks for are no mistake";
    EXPECT_EQ(d.lights[0].parameters.get_float("scale", 0), 4);
    EXPECT_EQ(d.area_lights[0].parameters.get_float("scale", 0), 4);
    EXPECT_EQ(d.materials[1].parameters.get_float("roughness", 0), 5);
    EXPECT_EQ(d.materials[2].parameters.get_float("roughness", 0), 5);
    EXPECT_EQ(d.media[0].parameters.get_float("g", 0), 6);
    EXPECT_EQ(d.textures[0].parameters.get_float("value", 0), 7);
    EXPECT_PRED2(contains, world_error_of("Attribute \"camera\" \"float fov\" 1"), "expected shape, light, material");
}

TEST(PbrtParser, MediaForCameraLightsAndShapes) {
    const Description d = parse(
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"\" \"fog\" Camera \"perspective\"\n"
        "WorldBegin LightSource \"point\" MediumInterface \"gas\" Shape \"a\" MediumInterface \"\" Shape \"b\"\n"
        "LightSource \"distant\" Translate 1 0 0 MakeNamedMedium \"gas\" \"string type\" \"cloud\"");
    EXPECT_EQ(d.media[*d.camera.medium].name, "fog");
    EXPECT_EQ(d.media[*d.lights[0].medium].name, "fog");
    EXPECT_EQ(d.media[*d.shapes[0].interior].type, "cloud");
    EXPECT_EQ(d.media[*d.shapes[0].exterior].type, "cloud");
    EXPECT_FALSE(d.shapes[1].interior);
    EXPECT_FALSE(d.lights[1].medium);
    expect_near(d.media[*d.shapes[0].interior].world_from_medium.point(Vec3(0)), Vec3(1, 0, 0));
}

TEST(PbrtParser, Textures) {
    const Description d = parse_world(
        "Translate 0 1 0 Texture \"a\" \"spectrum\" \"constant\" Texture \"a\" \"float\" \"constant\"\n"
        "Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\" Material \"diffuse\" \"texture reflectance\" "
        "\"b\"");
    ASSERT_EQ(d.textures.size(), 3u);
    EXPECT_EQ(d.textures[0].kind, TextureKind::spectrum);
    EXPECT_EQ(d.textures[1].kind, TextureKind::real);
    EXPECT_EQ(d.textures[2].type, "scale");
    expect_near(d.textures[0].world_from_texture.point(Vec3(0)), Vec3(0, 1, 0));
    EXPECT_PRED2(contains, world_error_of("Texture \"a\" \"colour\" \"constant\""), "kind float or spectrum");
    EXPECT_PRED2(contains, world_error_of("Texture \"a\" \"float\" \"scale\" \"texture tex\" \"b\""),
                 "t.pbrt:2:29: error: \"tex\": the texture \"b\" is not defined");
}

TEST(PbrtParser, ObjectsAndInstances) {
    const Description d = parse_world(
        "ObjectInstance \"tree\" Translate 1 0 0\nObjectBegin \"tree\" Translate 0 1 0 Shape \"leaf\" Shape \"trunk\" "
        "ObjectEnd\nTranslate 0 0 1 ObjectInstance \"tree\" Shape \"ground\"");
    ASSERT_EQ(d.objects.size(), 1u);
    EXPECT_EQ(d.objects[0].name, "tree");
    EXPECT_EQ(d.shapes[0].object, 0u);
    EXPECT_EQ(d.shapes[1].object, 0u);
    EXPECT_FALSE(d.shapes[2].object);
    expect_near(d.shapes[0].world_from_object.point(Vec3(0)), Vec3(1, 1, 0));
    ASSERT_EQ(d.instances.size(), 2u);
    expect_near(d.instances[0].world_from_instance.start().point(Vec3(0)), Vec3(0, 0, 0));
    expect_near(d.instances[1].world_from_instance.start().point(Vec3(0)), Vec3(1, 0, 1));
    EXPECT_EQ(d.instances[1].place.line, 4);
}

TEST(PbrtParser, AreaLightsInObjectsDoNotShine) {
    const Description d =
        parse_world("AreaLightSource \"diffuse\" ObjectBegin \"o\" Shape \"a\" ObjectEnd Shape \"b\"");
    EXPECT_FALSE(d.shapes[0].area_light);
    EXPECT_TRUE(d.shapes[1].area_light);
    ASSERT_EQ(d.warnings.size(), 1u);
    EXPECT_PRED2(contains, d.warnings[0], "t.pbrt:2:43: warning: ");
}

TEST(PbrtParser, TransformBlocksAreDeprecatedAttributeBlocks) {
    const Description d =
        parse_world("TransformBegin Translate 1 0 0 TransformEnd TransformBegin TransformEnd Shape \"a\"");
    EXPECT_EQ(d.shapes[0].world_from_object, Transform());
    EXPECT_EQ(d.warnings.size(), 1u);
}

TEST(PbrtParser, DirectivesInTheWrongPlaceAreErrors) {
    EXPECT_EQ(error_of("Camera \"perspective\"\n  Shape \"sphere\""),
              "t.pbrt:2:3: error: Shape is not allowed before WorldBegin");
    for (const char* text : {"Camera \"x\"", "Film \"x\"", "Sampler \"x\"", "Integrator \"x\"", "PixelFilter \"x\"",
                             "Accelerator \"x\"", "Option \"x\" 1", "WorldBegin"}) {
        EXPECT_PRED2(contains, world_error_of(text), "t.pbrt:2:1: error: ") << text;
        EXPECT_PRED2(contains, world_error_of(text), "is not allowed after WorldBegin") << text;
    }
    for (const char* text :
         {"AttributeBegin", "AttributeEnd", "LightSource \"x\"", "AreaLightSource \"x\"", "Material \"x\"",
          "MakeNamedMaterial \"x\"", "NamedMaterial \"x\"", "ObjectBegin \"x\"", "ObjectEnd", "ObjectInstance \"x\"",
          "ReverseOrientation", "Texture \"x\"", "Import \"x\"", "TransformBegin", "TransformEnd"}) {
        EXPECT_PRED2(contains, error_of(text), "is not allowed before WorldBegin") << text;
    }
}

TEST(PbrtParser, BlocksMustMatch) {
    const Description left_over = parse_world("Material \"interface\" AttributeEnd Shape \"a\"");
    EXPECT_EQ(left_over.materials[left_over.shapes[0].material].type, "interface");
    ASSERT_EQ(left_over.warnings.size(), 1u);
    EXPECT_PRED2(contains, left_over.warnings[0], "AttributeEnd without AttributeBegin is left out");
    EXPECT_EQ(world_error_of("ObjectEnd"), "t.pbrt:2:1: error: ObjectEnd without ObjectBegin");
    EXPECT_EQ(world_error_of("AttributeBegin\nAttributeBegin AttributeEnd"),
              "t.pbrt:2:1: error: AttributeBegin without AttributeEnd");
    EXPECT_EQ(world_error_of("ObjectBegin \"a\" AttributeEnd"),
              "t.pbrt:2:17: error: AttributeEnd, but the ObjectBegin at t.pbrt:2:1 is still open");
    EXPECT_EQ(world_error_of("ObjectBegin \"a\"\nAttributeBegin ObjectEnd"),
              "t.pbrt:3:16: error: ObjectEnd, but the AttributeBegin at t.pbrt:3:1 is still open");
    EXPECT_EQ(world_error_of("ObjectBegin \"a\"\nObjectBegin \"b\""),
              "t.pbrt:3:1: error: ObjectBegin within the object \"a\" at t.pbrt:2:1");
    EXPECT_PRED2(contains, world_error_of("ObjectBegin \"a\" ObjectInstance \"a\" ObjectEnd"), "part of an object");
    EXPECT_EQ(error_of("Film \"rgb\"\n"), "t.pbrt:2:1: error: the file ends before WorldBegin");
}

TEST(PbrtParser, NestingHasALimit) {
    std::string text = "WorldBegin";
    for (int i = 0; i < 20'000; ++i) {
        text += " AttributeBegin";
    }
    EXPECT_PRED2(contains, error_of(text), "nested more than 10000 deep");
}

TEST(PbrtParser, NamesMustBeDefinedOnce) {
    EXPECT_EQ(world_error_of("Shape \"a\"\n NamedMaterial \"x\" Shape \"b\""),
              "t.pbrt:3:2: error: the material \"x\" is not defined");
    EXPECT_EQ(world_error_of("MediumInterface \"x\" \"\" Shape \"a\""),
              "t.pbrt:2:1: error: the medium \"x\" is not defined");
    EXPECT_EQ(world_error_of("MediumInterface \"\" \"x\" LightSource \"point\""),
              "t.pbrt:2:1: error: the medium \"x\" is not defined");
    EXPECT_EQ(world_error_of("ObjectInstance \"x\""), "t.pbrt:2:1: error: the object \"x\" is not defined");
    EXPECT_EQ(world_error_of("Material \"diffuse\"\n  \"texture reflectance\" \"x\""),
              "t.pbrt:3:3: error: \"reflectance\": the texture \"x\" is not defined");
    EXPECT_EQ(
        world_error_of("MakeNamedMaterial \"x\" \"string type\" \"a\"\nMakeNamedMaterial \"x\" \"string type\" \"b\""),
        "t.pbrt:3:1: error: the material \"x\" is defined twice; the first is at t.pbrt:2:1");
    EXPECT_PRED2(
        contains,
        world_error_of("MakeNamedMedium \"x\" \"string type\" \"a\" MakeNamedMedium \"x\" \"string type\" \"a\""),
        "defined twice");
    EXPECT_PRED2(contains, world_error_of("ObjectBegin \"x\" ObjectEnd ObjectBegin \"x\" ObjectEnd"), "defined twice");
    EXPECT_PRED2(contains, world_error_of("Texture \"x\" \"float\" \"c\" Texture \"x\" \"float\" \"c\""),
                 "defined twice");
}

TEST(PbrtParser, NamesThatNothingUsesNeedNotBeDefined) {
    const Description d = parse_world(
        "NamedMaterial \"x\" MediumInterface \"y\" \"z\" Material \"interface\" MediumInterface \"\" \"\" Shape \"a\"");
    EXPECT_EQ(d.materials[d.shapes[0].material].type, "interface");
    EXPECT_FALSE(d.shapes[0].interior || d.shapes[0].exterior);
    EXPECT_TRUE(d.media.empty());
    EXPECT_TRUE(d.warnings.empty());
}

TEST(PbrtParser, OptionsAndColourSpacesAreNamedInAnyCase) {
    const Description d = parse(
        "Option \"force-Diffuse\" true Option \"int_seed\" 3 ColorSpace \"Rec2020\" WorldBegin Shape \"a\" \"rgb c\" "
        "[1 1 1]");
    EXPECT_TRUE(d.options.get_bool("forcediffuse", false));
    EXPECT_EQ(d.options.get_int("intseed", 0), 3);
    EXPECT_EQ(std::get<RgbColour>(*d.shapes[0].parameters.get_colour("c")).space, ColourSpace::rec2020);
    const Description unknown = parse("ColorSpace \"cmyk\" WorldBegin Shape \"a\" \"rgb c\" [1 1 1]");
    EXPECT_EQ(std::get<RgbColour>(*unknown.shapes[0].parameters.get_colour("c")).space, ColourSpace::srgb);
    ASSERT_EQ(unknown.warnings.size(), 1u);
    EXPECT_PRED2(contains, unknown.warnings[0], "known are srgb, dci-p3, rec2020 and aces2065-1");
}

TEST(PbrtParser, NamedMaterialsAndMediaNeedAType) {
    EXPECT_PRED2(contains, world_error_of("MakeNamedMaterial \"x\""), "\"string type\" is missing");
    EXPECT_PRED2(contains, world_error_of("MakeNamedMedium \"x\""), "\"string type\" is missing");
    EXPECT_PRED2(contains, world_error_of("MakeNamedMedium \"\" \"string type\" \"a\""), "needs a name");
    EXPECT_PRED2(contains, world_error_of("MakeNamedMedium \"x\" \"integer type\" 1"),
                 "expected string, found integer");
}

TEST(PbrtParser, UnknownDirectivesAreErrors) {
    EXPECT_EQ(error_of("Film \"rgb\"\nCamara \"x\""), "t.pbrt:2:1: error: expected a directive, found \"Camara\"");
    EXPECT_PRED2(contains, world_error_of("VolumeIntegrator \"x\""),
                 "t.pbrt:2:1: error: VolumeIntegrator is a part of");
    EXPECT_EQ(error_of("]"), "t.pbrt:1:1: error: expected a directive, found ']'");
    EXPECT_EQ(error_of("\"float x\" 1"), "t.pbrt:1:1: error: expected a directive, found \"float x\"");
    EXPECT_EQ(error_of("Camera perspective"), "t.pbrt:1:8: error: expected a quoted string, found \"perspective\"");
    EXPECT_PRED2(contains, error_of(""), "t.pbrt:1:1: error: the file ends before WorldBegin");
}

}  // namespace
}  // namespace wend::pbrt
