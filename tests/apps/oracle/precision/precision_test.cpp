#include "apps/bench/precision/precision.h"

#include <doctest/doctest.h>

#include <numeric>
#include <string>

#include "apps/system/interrupt.h"
#include "core/base/expect.h"
#include "tests/support/checked_floor.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests {
namespace {

apps::PictureOptions sized(int side) {
  apps::PictureOptions picture;
  picture.resolution = apps::Resolution{side, side};
  return picture;
}

TEST_CASE("a scene of flat matt surfaces has the same 8 bits in float and in double") {
  const apps::Precision precision = apps::measure_precision(built_in("tetra-4"), sized(64));
  CHECK(precision.pixels == 4096);
  CHECK(precision.primitives == 256);
  CHECK(precision.rays > 4096);
  CHECK(precision.differing_pixels == 0);
  CHECK(precision.root_mean_square > 0);
  CHECK(precision.root_mean_square < 1e-6);
  CHECK(precision.largest < 1e-5);
}

TEST_CASE("every pixel that differs has a cause") {
  const apps::Precision precision = apps::measure_precision(built_in("balls-3"), sized(96));
  CHECK(precision.differing_pixels > 10);
  CHECK(std::accumulate(precision.causes.begin(), precision.causes.end(), std::uint64_t{0}) == precision.differing_pixels);
  CHECK(precision.causes.back() == 0);
  CHECK(precision.errors.empty());
  CHECK(precision.largest_step > 0);
  CHECK(precision.largest_step <= apps::StepAudit::steps_allowed);
}

TEST_CASE("every scene of the SPD is explained at a small size") {
  for (const char* name :
       {"gears-2", "jacks-2", "lattice-4", "mount-4", "rings-2", "shells-3", "sombrero-1", "teapot-5", "tree-6"}) {
    CAPTURE(std::string(name));
    CHECK(apps::measure_precision(built_in(name), sized(64)).errors.empty());
  }
}

TEST_CASE("a scene with textures has the same 8 bits in float and in double but where shares are rounded, and is explained") {
  const apps::Precision floor = apps::measure_precision(CheckedFloor::painted(), sized(64));
  CHECK(floor.errors.empty());
  CHECK(floor.differing_pixels < 60);  // mirrored rays have the width of their cones in two bytes
  CHECK(floor.root_mean_square < 1e-4);
  CHECK(apps::measure_precision(everything(), sized(64)).errors.empty());
}

TEST_CASE("more than one sample a pixel is not measured") {
  apps::PictureOptions picture = sized(8);
  picture.samples = 2;
  CHECK_THROWS_AS(apps::measure_precision(built_in("tetra-2"), picture), core::InternalError);
}

TEST_CASE("a stop ends the measurement") {
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(apps::measure_precision(built_in("tetra-2"), sized(8), {.stop = source.get_token()}), apps::Interrupted);
}

}  // namespace
}  // namespace dmpc::tests
