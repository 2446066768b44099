#include "apps/formats/whole_view.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "apps/formats/view_faults.h"
#include "tests/support/instanced_scene.h"

namespace dmpc::apps::whole_view_test {

using core::Vec3d;

TEST_CASE("the bounds are a sphere about the middle of the box of the vertices that there are") {
  const BoundingSphere bounds = sphere_around({{{-1, 0, 0}, {3, 0, 0}, {9, 9, 9}, {1, 1, 0}}, {0, 1, 0, 3}}, {}, {});
  CHECK(bounds.center == Vec3d{1, 0.5, 0});
  CHECK(bounds.radius == doctest::Approx(2.0615528));
}

TEST_CASE("one vertex has bounds without a radius") { CHECK(sphere_around({{{5, 6, 7}}, {0}}, {}, {}).radius == 0); }

TEST_CASE("what stands in several places is around which the sphere lies in all of them, and not where it stands nowhere") {
  const IndexedVertices vertices{{{0, 0, 0}, {1, 0, 0}, {100, 0, 0}, {102, 0, 0}}, {0, 1, 0, 2, 3, 2}};
  const std::vector<core::Object> objects{{.first = 0, .vertex_count = 3}, {.first = 3, .vertex_count = 3}};
  const core::Instances instances{.meshes = {{1, 2}},
                                  .places = {{{.shift = {-100, 0, 0}}, 0, 2}, {{.shift = {-106, 0, 0}}, 0, 2}}};
  const BoundingSphere bounds = sphere_around(vertices, objects, instances);
  CHECK(bounds.center == Vec3d{-2, 0, 0});
  CHECK(bounds.radius == 4);
}

TEST_CASE("it is the expanded scene's sphere to the bit, however many places lie apart, beside what is round") {
  const auto indexed = [](const std::vector<Vec3d>& vertices) {
    IndexedVertices all{vertices, std::vector<std::uint32_t>(vertices.size())};
    std::iota(all.indices.begin(), all.indices.end(), 0U);
    return all;
  };
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    auto [scene, instances] = tests::instanced_scene(seed);
    const BoundingSphere sphere = sphere_around(indexed(scene.vertices), scene.objects, instances, scene.spheres);
    expand(scene, instances);
    const BoundingSphere expected = sphere_around(indexed(scene.vertices), {}, {}, scene.spheres);
    CHECK(sphere.center == expected.center);
    CHECK(sphere.radius == expected.radius);
  }
}

TEST_CASE("the sphere touches the picture's edge, for every axis that may be up") {
  for (const std::size_t axis : {0U, 1U, 2U}) {
    for (const bool is_negative : {false, true}) {
      const core::View view = whole_view({{1, 2, 3}, 4}, {axis, is_negative});
      CHECK_FALSE(fault_of(view));
      CHECK(4 / length(view.from - view.at) == doctest::Approx(0.38268343));  // the sine of 22.5 degrees
      CHECK((is_negative ? view.from[axis] < view.at[axis] : view.from[axis] > view.at[axis]));
      CHECK(view.up[axis] == (is_negative ? -1 : 1));
    }
  }
}

TEST_CASE("with its axis the other way up a view stands on its head and still shows the front") {
  const core::View upright = whole_view({{0, 0, 0}, 1}, {2}), turned = whole_view({{0, 0, 0}, 1}, {2, true});
  CHECK(turned.from.x == -upright.from.x);
  CHECK(turned.from.y == upright.from.y);
  CHECK(turned.from.z == -upright.from.z);
}

TEST_CASE("the key light is above the eye, the fill in it") {
  const core::View view = whole_view({{0, 0, 0}, 1}, {});
  const auto lights = plain_lights({{0, 0, 0}, 1}, view);
  CHECK(length(lights[0].position) == doctest::Approx(1000));
  CHECK(normalize(lights[0].position).y > normalize(view.from).y);
  CHECK(lights[1].position == view.from);
}

}  // namespace dmpc::apps::whole_view_test
