#include <doctest/doctest.h>

#include "apps/lab/bench/precision/precision.h"
#include "tests/support/large_bodies.h"

namespace dmpc::tests::large_bodies_test {
namespace {

apps::Precision measured(const core::Scene& scene) {
  apps::PictureOptions picture;
  picture.resolution = apps::Resolution{64, 64};
  return apps::measure_precision(scene, picture);
}

TEST_CASE("small things beside a large body keep their shadows and mirrored pictures, whatever its radius") {
  for (const LargeBody body : {LargeBody::planet, LargeBody::pipe, LargeBody::mountain, LargeBody::room}) {
    for (const double radius : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
      CAPTURE(static_cast<int>(body));
      CAPTURE(radius);
      const apps::Precision precision = measured(beside_large(body, radius));
      CHECK(precision.differing_pixels <= 4);
      CHECK(precision.root_mean_square < 1e-3);
      CHECK(precision.errors.empty());
    }
  }
}

}  // namespace
}  // namespace dmpc::tests::large_bodies_test
