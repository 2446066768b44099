#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/scene/frame.h"
#include "tests/support/shooting.h"

namespace flat_cone_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// A ring about `middle`, between two radii, across an axis of unit length.
struct Ring {
  Vec3d middle, axis;
  double wide = 0, narrow = 0;

  std::optional<double> distance(const Vec3d& from, const Vec3d& direction) const {
    const double t = dot(middle - from, axis) / dot(direction, axis);
    const double off = length(from + direction * t - middle);
    return t > 0 && off >= narrow && off <= wide ? std::optional(t) : std::nullopt;
  }
};

Ring random_ring(Random& random) {
  const double wide = random.between(0.1, 1.0);
  return {random.in_box(-2, 2), random.direction(), wide, random.below(3) == 0 ? 0.0 : wide * random.unit() * 0.9};
}

/// The disc as a cone of this small height, within a scene of extent 8.
Scene as_cone(const Ring& ring, double height) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({});
  builder.polygon({{-4, -4, -4}, {4, -4, -4}, {4, 4, -4}});
  builder.polygon({{-4, -4, 4}, {4, -4, 4}, {4, 4, 4}});
  builder.cone(ring.middle - ring.axis * (height / 2), ring.wide, ring.middle + ring.axis * (height / 2), ring.narrow);
  return scene;
}

}  // namespace

TEST_CASE("a cone that is all but a disc is met where the disc is, however thin") {
  Random random(1);
  for (const double height : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
    for (int i = 0; i < 40; ++i) {
      const Ring ring = random_ring(random);
      const Scene scene = as_cone(ring, height);
      const Database database = build_database(scene, {});
      REQUIRE(database.primitives().size() == 3);
      const double scale = database.header().frame.scale;
      for (int k = 0; k < 40; ++k) {
        const Vec3d at = ring.middle + normalize(cross(ring.axis, random.direction())) * (random.unit() * 1.3 * ring.wide);
        const Vec3d from = at + random.direction() * random.between(0.5, 3.0);
        Ray ray;
        ray.start_at(to_local(database.header().frame, from));
        ray.go_along(normalize(at - from));
        ray.kind = RayKind::reflected;
        const double off = length(at - ring.middle), slant = std::fabs(dot(ray.full_direction(), ring.axis));
        const double blur = (height + 1e-6 + 1e-15 / height) / slant;  // doubles tell the ends apart by so much
        if (std::fabs(off - ring.wide) < blur || std::fabs(off - ring.narrow) < blur || slant < 1e-3) {
          continue;
        }
        const float t = intersect_cone(ray, database.primitives()[2].value.data(), 1, 0);
        const std::optional<double> expected = ring.distance(from, ray.full_direction());
        CAPTURE(height);
        CAPTURE(off / ring.wide);
        CAPTURE(ring.narrow / ring.wide);
        REQUIRE((t > 0) == expected.has_value());
        if (expected) {
          REQUIRE(std::fabs(double{t} / scale - *expected) < blur);
        }
      }
    }
  }
}

TEST_CASE("a disc that is thinner than doubles can tell is left out, and said to be as large as it is") {
  const Ring ring{{1, 0.3, -0.2}, normalize(Vec3d{1, 2, 3}), 0.5, 0.1};
  CHECK(build_database(as_cone(ring, 1e-11), {}).dropped() == 0);
  const Database database = build_database(as_cone(ring, 3e-15), {});
  REQUIRE(database.collapsed().size() == 1);
  CHECK(double{database.collapsed()[0].size} / database.header().frame.scale == doctest::Approx(1).epsilon(1e-3));
}

}  // namespace flat_cone_test
