// Bad input ends in a message that names the place and exit status 2: no crash, no hang, no memory taken for nothing.
#include "program_support.h"
#include "tests/support/paths.h"
#include "tests/support/peak_memory.h"

#include <wend/core/random.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

namespace wend {
namespace {

using test::run_wend;
using test::small_scene;

class BadInput : public testing::Test {
protected:
    /// Renders at the smallest size, within bounds of work and memory.
    test::ProgramResult render(const std::string& scene, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", scene, "-o", folder_.file("out.exr"), "--quiet"});
        const test::PeakMemory memory;
        const test::ResourceLimit limit = test::ten_more_seconds_of_work();
        const auto result = run_wend(more);
        EXPECT_LT(memory.growth(), 256 << 20) << result.err;
        return result;
    }
    test::ProgramResult render_text(const std::string& text, std::vector<std::string> more = {}) const {
        if (more.empty()) {
            more = {"--spp", "1", "--resolution", "4x4"};
        }
        return render(folder_.write("scene.pbrt", text), more);
    }

    /// Exit status 2, nothing written, and a message of one line that begins with a place in `file` and holds `part`.
    void expect_refused(const test::ProgramResult& result, const std::string& part,
                        const std::string& file = "scene.pbrt", bool with_line = true) const {
        EXPECT_EQ(result.status, 2) << part << "\n" << result.err;
        EXPECT_TRUE(result.out.empty());
        EXPECT_EQ(result.err.rfind(folder_.file(file) + ":", 0), 0u) << part << ": no place in: " << result.err;
        if (with_line) {
            EXPECT_TRUE(std::regex_search(result.err, std::regex(":[0-9]+:[0-9]+: error: "))) << result.err;
        }
        EXPECT_NE(result.err.find(part), std::string::npos) << "'" << part << "' is not in: " << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_FALSE(std::filesystem::remove(folder_.file("out.exr"))) << part << ": a picture was written";
    }
    void expect_refused_world(const std::string& world, const std::string& part) const {
        expect_refused(render_text(small_scene(world)), part);
    }

    /// A picture, and it is black or not as `black` says.
    void expect_rendered(const test::ProgramResult& result, bool black = false) const {
        EXPECT_EQ(result.status, 0) << result.err;
        if (result.status != 0) {
            return;
        }
        bool dark = true;
        for (const Rgb& pixel : read_image(folder_.file("out.exr")).pixels) {
            EXPECT_TRUE(is_finite(pixel));
            dark &= is_black(pixel);
        }
        EXPECT_EQ(dark, black);
        std::filesystem::remove(folder_.file("out.exr"));
    }

    std::string replaced(const std::string& from, const std::string& to) const {
        std::string text = small_scene();
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    }

    test::ScratchFolder folder_;
};

std::string noise(std::size_t size, std::uint64_t seed) {
    Pcg32 random(seed);
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) {
        bytes += static_cast<char>(random.uniform() * 256);
    }
    return bytes;
}

TEST_F(BadInput, ASceneCutAnywhereRendersOrIsRefused) {
    const std::string whole = small_scene();
    int rendered = 0, refused = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const bool at_line_end = size > 0 && whole[size - 1] == '\n';
        if (size % 37 != 0 && !at_line_end) {
            continue;
        }
        const auto result = render_text(whole.substr(0, size));
        if (result.status == 2) {
            ++refused;
            EXPECT_EQ(result.err.rfind(folder_.file("scene.pbrt"), 0), 0u) << size << ": " << result.err;
            EXPECT_FALSE(std::filesystem::exists(folder_.file("out.exr")));
        } else {
            ++rendered;
            EXPECT_EQ(result.status, 0) << size << ": " << result.err;
            std::filesystem::remove(folder_.file("out.exr"));
        }
    }
    EXPECT_GT(rendered, 0) << "a cut between two shapes leaves a scene";
    EXPECT_GT(refused, 0);
}

TEST_F(BadInput, ASceneWithAByteChangedRendersOrIsRefused) {
    const std::string whole = small_scene();
    Pcg32 random(3);
    for (int i = 0; i < 150; ++i) {
        std::string text = whole;
        text[static_cast<std::size_t>(random.uniform() * static_cast<float>(text.size()))] =
            static_cast<char>(random.uniform() * 256);
        const auto result = render_text(text);
        EXPECT_TRUE(result.status == 0 || result.status == 2) << result.err << text;
    }
}

TEST_F(BadInput, FilesThatAreNoScene) {
    expect_refused(render(folder_.file("absent.pbrt")), "No such file", "absent.pbrt", false);
    expect_refused(render_text(""), "WorldBegin", "scene.pbrt", false);
    expect_refused(render_text("\n\n# nothing\n"), "WorldBegin", "scene.pbrt", false);
    std::filesystem::create_directory(folder_.path() / "folder.pbrt");
    expect_refused(render(folder_.file("folder.pbrt")), "", "folder.pbrt", false);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto result = render_text(noise(4096, seed));
        EXPECT_EQ(result.status, 2);
        EXPECT_EQ(result.err.rfind(folder_.file("scene.pbrt") + ":", 0), 0u) << result.err;
    }
    expect_refused(render_text(std::string(1 << 20, '\0')), "");
    expect_refused(render_text(std::string(1 << 20, '[')), "");
    expect_refused(render_text("Film \"rgb\" \"string filename\" \"" + std::string(1 << 20, 'x')), "");
    std::string nested = "WorldBegin\n";
    for (int i = 0; i < 100000; ++i) {
        nested += "AttributeBegin\n";
    }
    EXPECT_EQ(render_text(nested).status, 2);
}

TEST_F(BadInput, FilesThatTheSceneMissesAreNamed) {
    expect_refused_world("Include \"absent.pbrt\"\n", "absent.pbrt");
    expect_refused_world("Import \"absent.pbrt\"\n", "absent.pbrt");
    expect_refused_world("Shape \"plymesh\" \"string filename\" \"absent.ply\"\n", "absent.ply");
    expect_refused_world("Shape \"plymesh\"\n", "filename");
    expect_refused_world("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"absent.png\"\n", "absent.png");
    expect_refused_world("LightSource \"infinite\" \"string filename\" \"absent.exr\"\n", "absent.exr");
    expect_refused_world("MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"absent.nvdb\"\n",
                         "absent.nvdb");
    expect_refused_world("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \".\"\n", "");
}

TEST_F(BadInput, IncludesThatGoInCircles) {
    expect_refused_world("Include \"scene.pbrt\"\n", "scene.pbrt");
    folder_.write("a.pbrt", "Include \"b.pbrt\"\n");
    folder_.write("b.pbrt", "Include \"a.pbrt\"\n");
    const auto result = render_text(small_scene("Include \"a.pbrt\"\n"));
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find(".pbrt:"), std::string::npos) << result.err;
}

TEST_F(BadInput, NumbersThatAreNone) {
    const std::string triangle = R"(Shape "trianglemesh" "integer indices" [ 0 1 2 ] "point3 P" )";
    expect_refused_world(triangle + "[ 0 0 nan  0 1 0  1 0 0 ]\n", "");
    expect_refused_world(triangle + "[ 0 0 inf  0 1 0  1 0 0 ]\n", "");
    expect_refused_world(triangle + "[ 0 0 1e39  0 1 0  1 0 0 ]\n", "");
    expect_refused_world("LightSource \"infinite\" \"rgb L\" [ nan 1 1 ]\n", "");
    expect_refused_world("LightSource \"point\" \"rgb I\" [ 1 1 1 ] \"point3 from\" [ nan 0 0 ]\n", "");
    expect_refused_world("LightSource \"point\" \"rgb I\" [ 1 1 1e60 ]\n", "");
    expect_refused_world("LightSource \"infinite\" \"rgb L\" [ -1 1 1 ]\n", "negative");
    expect_refused_world("AreaLightSource \"diffuse\" \"rgb L\" [ 1 nan 1 ]\n" + triangle + "[ 0 0 0 0 1 0 1 0 0 ]\n",
                         "");
    expect_refused_world("Shape \"sphere\" \"float radius\" [ -1 ]\n", "radius");
    expect_refused_world("Translate nan 0 0\n", "");
    expect_refused_world("Transform [ 1 0 0 0 0 1 0 0 0 0 inf 0 0 0 0 1 ]\n", "");
}

TEST_F(BadInput, MediaThatCannotBe) {
    const auto medium = [](const std::string& rest) {
        return "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" " + rest + "\n";
    };
    expect_refused_world(medium("\"rgb sigma_a\" [ -1 0 0 ]"), "negative");
    expect_refused_world(medium("\"rgb sigma_s\" [ 0 0 nan ]"), "");
    expect_refused_world(medium("\"float scale\" [ -2 ]"), "scale");
    for (const char* g : {"1", "-1", "1.5", "-7"}) {
        expect_refused_world(medium(std::string("\"float g\" [ ") + g + " ]"), "\"g\"");
    }
    expect_refused_world("MakeNamedMedium \"m\" \"string type\" \"syrup\"\n", "syrup");
    expect_refused_world("MakeNamedMedium \"m\"\n", "type");
    expect_refused_world("MediumInterface \"nowhere\" \"\"\nShape \"sphere\"\n", "nowhere");
    expect_refused_world(
        "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" [ 10000 ] \"integer ny\" [ 10000 ]\n"
        "  \"integer nz\" [ 10000 ] \"float density\" [ 1 ]\n",
        "density");
    expect_refused_world(
        "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" [ 2 ]\n"
        "  \"float density\" [ 1 -1 ]\n",
        "density");
    expect_refused_world(
        "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" [ -1 ]\n"
        "  \"integer ny\" [ -1 ] \"float density\" [ 1 ]\n",
        "density");
}

TEST_F(BadInput, CamerasAndFilmsThatCannotBe) {
    const std::string fov = "\"float fov\" [ 32 ]";
    for (const char* angle : {"0", "-30", "180", "720", "1e30", "nan"}) {
        const std::string bad = std::string("\"float fov\" [ ") + angle + " ]";
        expect_refused(render_text(replaced(fov, bad)), "");
    }
    expect_refused(render_text(replaced("LookAt 0 1 5.2  0 1 0", "LookAt 0 1 5.2  0 1 5.2")), "viewing direction");
    for (const char* width : {"0", "-5", "1000000000", "99999999999", "1.5", "\"wide\""}) {
        const std::string bad = std::string("\"integer xresolution\" [ ") + width + " ]";
        expect_refused(render_text(replaced("\"integer xresolution\" [ 16 ]", bad), {"--spp", "1"}), "");
    }
    expect_refused(
        render_text(replaced("\"integer yresolution\" [ 12 ]", "\"integer yresolution\" [ 0 ]"), {"--spp", "1"}),
        "yresolution");
    expect_refused(render_text(replaced("xresolution\" [ 16 ]", "xresolution\" [ 1000000000 ]"), {"--spp", "1"}),
                   "1000000000");
    expect_refused(render_text(replaced("\"integer pixelsamples\" [ 4 ]", "\"integer pixelsamples\" [ 0 ]")),
                   "pixelsamples");
    expect_refused(render_text(replaced("\"float xradius\" [ 1.5 ]", "\"float xradius\" [ 0 ]")), "xradius");
    expect_refused(render_text(replaced("\"integer maxdepth\" [ 8 ]", "\"integer maxdepth\" [ -8 ]")), "maxdepth");
    // Wide, but possible.
    expect_rendered(render_text(replaced(fov, "\"float fov\" [ 150 ]"), {"--spp", "16"}));
}

TEST_F(BadInput, SamplesBeyondAllTimeYieldToTheTimeGiven) {
    const std::string text = replaced("\"integer pixelsamples\" [ 4 ]", "\"integer pixelsamples\" [ 2000000000 ]");
    expect_rendered(render_text(text, {"--time", "0.05"}));
}

TEST_F(BadInput, ParametersOfTheWrongKind) {
    expect_refused_world("Shape \"sphere\" \"string radius\" \"big\"\n", "radius");
    expect_refused_world("Shape \"sphere\" \"float radius\" \"big\"\n", "");
    expect_refused_world("Shape \"sphere\" \"float radius\" [ 1 2 ]\n", "radius");
    expect_refused_world("Shape \"sphere\" \"frob radius\" [ 1 ]\n", "frob");
    expect_refused_world("Shape \"sphere\" \"radius\" [ 1 ]\n", "radius");
    expect_refused_world("Shape \"frob\"\n", "frob");
    expect_refused_world("Material \"frob\"\n", "frob");
    expect_refused_world("NamedMaterial \"nobody\"\nShape \"sphere\"\n", "nobody");
    expect_refused_world("Frobnicate \"x\"\n", "Frobnicate");
    expect_refused_world("LightSource \"frob\"\n", "frob");
    expect_refused_world("AttributeBegin\n", "AttributeBegin");
    expect_refused_world("ObjectInstance \"nothing\"\n", "nothing");
    expect_refused_world("Translate 1 2\n", "");
    expect_refused_world("WorldBegin\n", "WorldBegin");
    expect_refused_world("Camera \"perspective\"\n", "Camera");
    // As pbrt does: with a warning.
    expect_rendered(render_text(small_scene("AttributeEnd\n")));
}

TEST_F(BadInput, MeshesThatDoNotHoldTogether) {
    const std::string corners = R"("point3 P" [ 0 0 0  0 1 0  1 0 0 ] )";
    expect_refused_world("Shape \"trianglemesh\" " + corners + "\"integer indices\" [ 0 1 3 ]\n", "index 3");
    expect_refused_world("Shape \"trianglemesh\" " + corners + "\"integer indices\" [ 0 1 -1 ]\n", "index -1");
    expect_refused_world("Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ]\n", "");
    expect_refused_world("Shape \"trianglemesh\" \"point3 P\" [ 0 0 ]\n", "P");
}

TEST_F(BadInput, FilesOfNoise) {
    const std::string exr("\x76\x2f\x31\x01\x02\0\0\0", 8), png = "\x89PNG\r\n\x1a\n";
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n";
    const std::string nanovdb = "NanoVDB0", openvdb(" BDV\0\0\0\0", 8), jpeg = "\xff\xd8\xff\xe0";
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        for (const std::string& start : {std::string(), exr, png, ply, nanovdb, openvdb, jpeg}) {
            folder_.write("noise.bin", start + noise(2000, seed));
            for (const char* use :
                 {"Shape \"plymesh\" \"string filename\" \"noise.bin\"\n",
                  "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"noise.bin\"\n"
                  "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n",
                  "LightSource \"infinite\" \"string filename\" \"noise.bin\"\n",
                  "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"noise.bin\"\n"}) {
                const auto result = render_text(small_scene(use));
                EXPECT_EQ(result.status, 2) << use << result.err;
                EXPECT_NE(result.err.find("noise.bin"), std::string::npos) << use << result.err;
            }
        }
    }
}

TEST_F(BadInput, FilesCutAnywhere) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    Picture picture;
    picture.image = Image(8, 8);
    for (Rgb& pixel : picture.image.pixels) {
        pixel = Rgb(0.5f);
    }
    write_picture(folder_.file("whole.exr"), picture);
    write_picture(folder_.file("whole.png"), picture);
    struct Kind {
        std::string content;
        std::string use;
    };
    for (const Kind& kind : {Kind{ply, "Shape \"plymesh\" \"string filename\" \"cut.bin\"\n"},
                             Kind{test::read_text(folder_.file("whole.exr")),
                                  "LightSource \"infinite\" \"string filename\" \"cut.bin\"\n"},
                             Kind{test::read_text(folder_.file("whole.png")),
                                  "LightSource \"infinite\" \"string filename\" \"cut.bin\"\n"}}) {
        folder_.write("cut.bin", kind.content);
        expect_rendered(render_text(small_scene(kind.use), {"--spp", "16"}));
        // The last bytes may be no more than a line's end.
        for (std::size_t size = 0; size + 4 < kind.content.size(); size += 7) {
            folder_.write("cut.bin", kind.content.substr(0, size));
            const auto result = render_text(small_scene(kind.use));
            EXPECT_EQ(result.status, 2) << size << ' ' << kind.use << result.err;
            EXPECT_NE(result.err.find("cut.bin"), std::string::npos) << result.err;
        }
    }
}

TEST_F(BadInput, VolumesCutAnywhere) {
    for (const char* name : {"smoke.nvdb", "smoke.vdb"}) {
        const auto file = test::shared_dir() / "scenes" / "smoke" / name;
        if (!std::filesystem::exists(file)) {
            GTEST_SKIP() << "no collection of volumes beside the checkout: " << file;
        }
        const std::string whole = test::read_text(file);
        for (int i = 0; i < 8; ++i) {
            const std::size_t size = whole.size() * static_cast<std::size_t>(i) / 8 + static_cast<std::size_t>(i) * 13;
            folder_.write("cut.bin", std::string_view(whole).substr(0, size));
            const auto result = render_text(
                small_scene("MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"cut.bin\"\n"));
            EXPECT_EQ(result.status, 2) << name << " cut at " << size;
            EXPECT_NE(result.err.find("cut.bin"), std::string::npos) << result.err;
        }
    }
}

TEST_F(BadInput, MetricOfFilesThatAreNoPictures) {
    const std::string noisy = folder_.write("noise.exr", noise(500, 1));
    const std::string empty = folder_.write("empty.png", "");
    for (const std::string& file : {noisy, empty, folder_.file("absent.exr"), folder_.path().string()}) {
        const auto result = run_wend({"metric", file, file});
        EXPECT_EQ(result.status, 2) << file;
        EXPECT_EQ(result.err.rfind(file + ":", 0), 0u) << result.err;
    }
}

TEST_F(BadInput, OddScenesStillRender) {
    const std::string head =
        "Integrator \"volpath\" \"integer maxdepth\" [ 5 ]\nLookAt 0 0 5  0 0 0  0 1 0\n"
        "Camera \"perspective\" \"float fov\" [ 40 ]\nWorldBegin\n";
    const std::string sky = "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";
    const std::vector<std::string> samples{"--spp", "16", "--resolution", "6x6"};
    const auto odd = [&](const std::string& world, bool black = false) {
        for (const char* sampling : {"classical", "direction"}) {
            SCOPED_TRACE(world + sampling);
            expect_rendered(render_text(head + world, {"--spp", "16", "--resolution", "6x6", "--sampling", sampling}),
                            black);
        }
    };
    odd("", true);                                                 // nothing at all
    odd("Shape \"sphere\"\n", true);                               // no light
    odd(sky);                                                      // no shape
    odd(sky + "Shape \"sphere\" \"float radius\" [ 8 ]\n", true);  // the eye inside of a closed shape
    odd(sky + "Shape \"disk\" \"float radius\" [ 1e-20 ]\n");      // hardly there
    odd(sky + "Shape \"sphere\" \"float radius\" [ 0 ]\n");        // not there at all, as in pbrt
    odd(sky +
        "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 ] \"point3 P\" [ 0 0 1 1 0 1 1 1 1 ]\n");  // one too many
    odd(sky + "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string preset\" \"Soup\"\n");  // unknown to all
    odd(sky + "Scale 1 1 1e-12\nShape \"sphere\"\n");                                                 // nearly flat
    odd(sky + "Shape \"sphere\" \"float radius\" [ 1e15 ]\n", true);                                  // vast
    odd(sky + "Translate 1e12 0 0\nShape \"sphere\"\n");                                              // far away
    odd("LightSource \"point\" \"rgb I\" [ 1e30 1e30 1e30 ]\nShape \"sphere\"\n", true);  // inside of the sphere
    odd("LightSource \"point\" \"point3 from\" [ 0 0 3 ] \"rgb I\" [ 1e30 1e30 1e30 ]\nShape \"sphere\"\n");
    odd(sky +
        "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]\n"  // a lamp without area
        "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  2 0 0 ]\n");
    odd(sky +
        "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] \"float power\" [ 5 ]\n"
        "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  0 0 0  0 0 0 ]\n");
    odd("AreaLightSource \"diffuse\" \"rgb L\" [ 0 0 0 ]\nShape \"sphere\"\n", true);  // a lamp that is off
    odd("LightSource \"point\" \"point3 from\" [ 0 0 5 ]\nShape \"sphere\"\n");        // a lamp in the eye
    odd(sky +
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"float scale\" [ 1e6 ]\n"
        "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");  // as dense as a wall
    odd(sky +
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] \"rgb sigma_s\" [ 0 0 0 ]\n"
        "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");  // a medium of nothing
    odd(sky +
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"float g\" [ 0.99999 ]\n"
        "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
    odd(sky +
        "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"float density\" [ 0 ]\n"
        "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
}

TEST_F(BadInput, TransformsThatCannotBeUndone) {
    for (const char* transform : {"Scale 0 1 1\n", "Transform [ 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1 ]\n",
                                  "ConcatTransform [ 1 1 1 0 1 1 1 0 1 1 1 0 0 0 0 1 ]\n", "Rotate 30 0 0 0\n"}) {
        // Nothing is seen by such a camera; a shape is left out.
        expect_refused(render_text(transform + small_scene("")), "");
        EXPECT_EQ(render_text(small_scene(std::string(transform) + "Shape \"sphere\"\n")).status, 0) << transform;
        EXPECT_TRUE(std::filesystem::remove(folder_.file("out.exr")));
    }
}

}  // namespace
}  // namespace wend
