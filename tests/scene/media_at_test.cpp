// The medium that a walk is in is that of the place it is at, whatever it has crossed on its way.
#include <tests/scene/small_scene.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace wend {
namespace {

constexpr MediumId mist = 0, wax = 1, glass = 2;

Shape box(const Box3& bounds) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back({i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                                  i & 4 ? bounds.max.z : bounds.min.z});
    }
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return mesh;
}

void add(SceneDescription& scene, Shape shape, MediumId interior, MediumId exterior = vacuum) {
    Surface& surface = test::add(scene, std::move(shape), 1);
    surface.interior = interior;
    surface.exterior = exterior;
}

Quadric ball(const Vec3& centre, float radius) {
    return {Sphere{radius, -radius, radius}, Transform::translate(centre.x, centre.y, centre.z)};
}

bool is_in(const Box3& bounds, const Vec3& p) {
    return p.x > bounds.min.x && p.x < bounds.max.x && p.y > bounds.min.y && p.y < bounds.max.y && p.z > bounds.min.z &&
           p.z < bounds.max.z;
}

bool is_in_ball(const Vec3& centre, float radius, const Vec3& p) {
    return length(p - centre) < radius;
}

struct Arrangement {
    std::string name;
    std::function<void(SceneDescription&)> build;
    std::function<MediumId(const Vec3&)> medium;  ///< at a place
    bool needs_regions = true;
};

void PrintTo(const Arrangement& arrangement, std::ostream* out) {
    *out << arrangement.name;
}

const Box3 left_box(Vec3(-1), Vec3(0, 1, 1)), right_box(Vec3(0, -1, -1), Vec3(1)), middle_box(Vec3(-0.5f), Vec3(0.5f));

/// The faces of both boxes, each a shape of its own; the one between them is there once.
void add_cells(SceneDescription& scene) {
    for (const bool is_left : {true, false}) {
        const auto whole = std::get<TriangleMesh>(box(is_left ? left_box : right_box));
        for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
            TriangleMesh face;
            bool is_between = true;
            for (std::size_t k = 0; k < 3; ++k) {
                face.positions.push_back(whole.positions[whole.indices[i + k]]);
                is_between = is_between && face.positions[k].x == 0;
            }
            face.indices = {0, 1, 2};
            if (is_left || !is_between) {
                add(scene, std::move(face), is_left ? mist : wax, is_between ? wax : vacuum);
            }
        }
    }
}

MediumId in_cells(const Vec3& p) {
    return is_in(left_box, p) ? mist : is_in(right_box, p) ? wax : vacuum;
}

std::vector<Arrangement> arrangements() {
    const auto either = [](const Vec3& p) { return is_in(left_box, p) || is_in(right_box, p); };
    return {
        {"TwoBoxesThatTouch",
         [](auto& s) {
             add(s, box(left_box), mist);
             add(s, box(right_box), mist);
         },
         [=](const Vec3& p) { return either(p) ? mist : vacuum; }},
        {"TwoMediaThatTouch",
         [](auto& s) {
             add(s, box(left_box), mist);
             add(s, box(right_box), wax);
         },
         [](const Vec3& p) { return is_in(left_box, p)    ? mist
                                    : is_in(right_box, p) ? wax
                                                          : vacuum; }},
        {"OverlapOfOneMedium",
         [](auto& s) {
             add(s, ball({-0.3f, 0, 0}, 0.7f), mist);
             add(s, ball({0.3f, 0, 0}, 0.6f), mist);
         },
         [](const Vec3& p) {
             return is_in_ball({-0.3f, 0, 0}, 0.7f, p) || is_in_ball({0.3f, 0, 0}, 0.6f, p) ? mist : vacuum;
         }},
        {"OverlapOfTwoMedia",
         [](auto& s) {
             add(s, ball({0.3f, 0, 0}, 0.6f), wax);
             add(s, ball({-0.3f, 0, 0}, 0.7f), mist);
         },
         [](const Vec3& p) {
             return is_in_ball({0.3f, 0, 0}, 0.6f, p) ? wax : is_in_ball({-0.3f, 0, 0}, 0.7f, p) ? mist : vacuum;
         }},
        {"NestedAndSaid",
         [](auto& s) {
             add(s, box(middle_box), wax, mist);
             add(s, ball({0, 0, 0}, 1), mist);
         },
         [](const Vec3& p) {
             return is_in(middle_box, p) ? wax : is_in_ball({0, 0, 0}, 1, p) ? mist : vacuum;
         },
         false},
        {"NestedAndNotSaid",
         [](auto& s) {
             add(s, ball({0, 0, 0}, 1), mist);
             add(s, box(middle_box), wax);
         },
         [](const Vec3& p) {
             return is_in(middle_box, p) ? wax : is_in_ball({0, 0, 0}, 1, p) ? mist : vacuum;
         }},
        {"ABubble",
         [](auto& s) {
             add(s, ball({0, 0, 0}, 1), mist);
             add(s, box(middle_box), vacuum, mist);
         },
         [](const Vec3& p) {
             return is_in(middle_box, p) ? vacuum : is_in_ball({0, 0, 0}, 1, p) ? mist : vacuum;
         },
         false},
        {"TwoThatTouchInAThird",
         [](auto& s) {
             add(s, ball({0, 0, 0}, 3), glass);
             add(s, box(left_box), mist, glass);
             add(s, box(right_box), wax, glass);
         },
         [](const Vec3& p) {
             return is_in(left_box, p)            ? mist
                    : is_in(right_box, p)         ? wax
                    : is_in_ball({0, 0, 0}, 3, p) ? glass
                                                  : vacuum;
         }},
        // A wall with a medium on either side, among other faces; and the same beside two balls that overlap.
        {"FacesThatAreShapes", add_cells, in_cells, false},
        {"FacesThatAreShapesBesideAnOverlap",
         [](auto& s) {
             add_cells(s);
             add(s, ball({0, 3, 0}, 1), glass);
             add(s, ball({0, 3.5f, 0}, 1), glass);
         },
         [](const Vec3& p) {
             return is_in_ball({0, 3, 0}, 1, p) || is_in_ball({0, 3.5f, 0}, 1, p) ? glass : in_cells(p);
         }},
    };
}

class MediaAt : public testing::TestWithParam<Arrangement> {};

TEST_P(MediaAt, AreThoseOfThePlace) {
    const Arrangement& arrangement = GetParam();
    auto description = test::two_materials();
    description.media.assign(3, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    arrangement.build(description);
    EXPECT_EQ(MediumRegions(description).is_empty(), !arrangement.needs_regions);
    const Scene scene(std::move(description));
    Pcg32 random(1);
    int seen = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 from = to_sphere(random.uniform2()) * 8.0f;
        const Vec3 to = Vec3(random.uniform(), random.uniform(), random.uniform()) * 2.0f - Vec3(1);
        TracedRay ray = Ray{from, normalize(to - from)};
        MediumState state;
        while (const auto hit = scene.intersect(ray)) {
            // What is shorter may be on either side, by rounding.
            if (hit->distance > 1e-4f) {
                ++seen;
                ASSERT_EQ(state.id, arrangement.medium(ray.at(0.5f * hit->distance)));
            }
            state = scene.medium_beyond(*hit, ray.direction, state);
            ray.pass(*hit);
        }
        ASSERT_EQ(state.id, vacuum);
    }
    EXPECT_GT(seen, 25000);
}

INSTANTIATE_TEST_SUITE_P(Arrangements, MediaAt, testing::ValuesIn(arrangements()),
                         [](const auto& each) { return each.param.name; });

TEST(MediaAt, AWalkMayBeginInSeveralRegions) {
    auto description = test::two_materials();
    description.media.assign(3, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    add(description, ball({-0.3f, 0, 0}, 0.7f), mist);
    add(description, ball({0.3f, 0, 0}, 0.6f), wax);
    description.camera = Camera(PerspectiveCamera{}, Transform(), 2, 2);
    description.camera_medium = wax;
    const Scene scene(std::move(description));
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        TracedRay ray = Ray{{0, 0, 0}, to_sphere(random.uniform2())};
        MediumState state = scene.camera_medium();
        while (const auto hit = scene.intersect(ray)) {
            const Vec3 p = ray.at(0.5f * hit->distance);
            ASSERT_EQ(state.id, is_in_ball({0.3f, 0, 0}, 0.6f, p) ? wax : mist);
            state = scene.medium_beyond(*hit, ray.direction, state);
            ray.pass(*hit);
        }
        ASSERT_EQ(state.id, vacuum);
    }
}

// Boundaries with holes enclose nothing: what they say of their sides is all there is.
TEST(MediaAt, OpenSurfacesAreBelieved) {
    auto description = test::two_materials();
    description.media.assign(3, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    add(description, test::square(0), mist, wax);
    add(description, ball({0, 0, 0}, 0.5f), glass);
    add(description, ball({0.3f, 0, 0}, 0.5f), glass);
    const Scene scene(std::move(description));
    const TracedRay ray = Ray{{0.9f, -0.9f, 2}, {0, 0, -1}};
    const auto hit = scene.intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_EQ(scene.medium_beyond(*hit, {0, 0, -1}, {}).id, mist);
    EXPECT_EQ(scene.medium_beyond(*hit, {0, 0, 1}, {}).id, wax);
}

}  // namespace
}  // namespace wend
