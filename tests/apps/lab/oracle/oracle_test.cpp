#include "apps/oracle/oracle.h"

#include <doctest/doctest.h>

#include <cmath>

#include <limits>
#include <random>
#include <string_view>

#include "apps/lab/oracle/referee.h"
#include "tests/apps/lab/oracle/primitives.h"

namespace dmpc::tests::oracle_test {
namespace {

using apps::EmbreeMode;
using apps::EmbreeScene;
using Primitives = std::vector<core::PrimitiveValues>;

const Primitives mixed{triangle({-1, -1, 3}, {1, -1, 3}, {0, 1, 3}), sphere({0, 0, 2}, 0.25F),
                       triangle({-1, -1, 1}, {1, -1, 1}, {0, 1, 1}), cone({0, -1, 5}, 0.5F, {0, 1, 5}, 0.25F)};

TEST_CASE("an empty scene is missed") {
  const EmbreeScene scene(Primitives{}, EmbreeMode::robust);
  CHECK_FALSE(scene.closest(ray({0, 0, 0}, {0, 0, 1})).found());
  CHECK_FALSE(scene.occluded(ray({0, 0, 0}, {0, 0, 1})));
}

TEST_CASE("the oracle names the nearest of triangles, spheres and cones by our ids") {
  for (const EmbreeMode mode : {EmbreeMode::robust, EmbreeMode::fast}) {
    const EmbreeScene scene(mixed, mode);
    CHECK(scene.closest(ray({0, 0, 0}, {0, 0, 1})).primitive == 2);
    CHECK(scene.closest(ray({0, 0, 1.5F}, {0, 0, 1})).primitive == 1);
    CHECK(scene.closest(ray({0, 0, 2.5F}, {0, 0, 1})).primitive == 0);
    CHECK(scene.closest(ray({0, 0, 4}, {0, 0, 1})).primitive == 3);
    CHECK(scene.closest(ray({0, 0, 4}, {0, 0, 1})).t == doctest::Approx(0.625).epsilon(0.05));
    CHECK_FALSE(scene.closest(ray({0, 0, 9}, {0, 0, 1})).found());
  }
}

TEST_CASE("a ray inside a sphere sees it again") {
  const EmbreeScene scene(mixed, EmbreeMode::robust);
  core::Ray inside = ray({0, 0, 2}, {0, 0, 1});
  inside.ignored_primitive = 1;
  CHECK(scene.closest(inside).primitive == 1);
  CHECK(scene.closest(inside).t == 0.25F);
}

TEST_CASE("the oracle looks past the triangle that a ray starts on") {
  const EmbreeScene scene(mixed, EmbreeMode::robust);
  core::Ray leaving = ray({0, 0, 0}, {0, 0, 1});
  leaving.ignored_primitive = 2;
  CHECK(scene.closest(leaving).primitive == 1);
  leaving.t_max = 1.5F;
  CHECK_FALSE(scene.occluded(leaving));
}

TEST_CASE("a hit at t_max does not count") {
  const EmbreeScene scene(mixed, EmbreeMode::robust);
  const float at = scene.closest(ray({0, 0, 0}, {0, 0, 1})).t;  // 1 except for the last bit: processors' reciprocals differ
  CHECK(at == doctest::Approx(1));
  CHECK_FALSE(scene.occluded(shadow_ray({0, 0, 0}, {0, 0, 1}, at)));
  CHECK(scene.occluded(shadow_ray({0, 0, 0}, {0, 0, 1}, std::nextafter(at, 2.0F))));
  CHECK_FALSE(scene.occluded(shadow_ray({0, 0, 1.25F}, {0, 0, 1}, 0.5F)));
  CHECK(scene.occluded(shadow_ray({0, 0, 1.25F}, {0, 0, 1}, 0.51F)));
}

TEST_CASE("of coincident triangles the oracle names the lowest id") {
  Primitives stack(50, mixed[0]);
  CHECK(EmbreeScene(stack, EmbreeMode::robust).closest(ray({0, 0, 0}, {0, 0, 1})).primitive == 0);
}

TEST_CASE("rays that are not finite miss") {
  const EmbreeScene scene(mixed, EmbreeMode::robust);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  CHECK_FALSE(scene.closest(ray({not_a_number, 0, 0}, {0, 0, 1})).found());
  CHECK_FALSE(scene.closest(ray({0, 0, 0}, {0, infinity, 0})).found());
  CHECK_FALSE(scene.occluded(ray({0, 0, 0}, {0, 0, not_a_number})));
}

/// A cloud of all kinds, ids mixed.
Primitives cloud(int count, std::mt19937& engine) {
  const auto uniform = [&] { return static_cast<float>(engine() >> 8U) * 0x1p-24F; };
  const auto point = [&] { return Vec3f{uniform(), uniform(), uniform()}; };
  Primitives result;
  for (int index = 0; index < count; ++index) {
    const Vec3f at = point();
    const auto near = [&] { return at + (point() - Vec3f{0.5F, 0.5F, 0.5F}) * 0.2F; };
    result.push_back(index % 3 == 0   ? triangle(at, near(), near())
                     : index % 3 == 1 ? sphere(at, 0.01F + 0.05F * uniform())
                                      : cone(at, 0.05F * uniform(), near(), 0.05F * uniform()));
  }
  return result;
}

TEST_CASE("oracle and referee agree on random rays through a cloud of all kinds") {
  std::mt19937 engine(7);
  const Primitives primitives = cloud(300, engine);
  const EmbreeScene scene(primitives, EmbreeMode::robust);
  const apps::Referee referee(primitives);
  const auto uniform = [&] { return static_cast<float>(engine() >> 8U) * 0x1p-23F - 0.5F; };
  int hits = 0, unexplained = 0;
  for (int round = 0; round < 3000; ++round) {
    const Vec3f origin{uniform(), uniform(), uniform()}, target{uniform(), uniform(), uniform()};
    core::Ray from = ray(origin, normalize(target - origin));
    const core::Hit named = scene.closest(from);
    hits += named.found() ? 1 : 0;
    unexplained += referee.admissible(from, {named.found(), named.primitive, named.t}, apps::Renderer::embree) ? 0 : 1;
    from.kind = core::RayKind::shadow;
    from.t_max = 0.3F;
    unexplained += referee.admissible(from, {scene.occluded(from), core::no_primitive, 0}, apps::Renderer::embree) ? 0 : 1;
  }
  CHECK(hits > 500);
  CHECK(unexplained == 0);
}

TEST_CASE("the linked version of Embree is named") { CHECK(std::string_view(apps::embree_version()).size() >= 5); }

}  // namespace
}  // namespace dmpc::tests::oracle_test
