#include "apps/lab/oracle/reference/reference.h"

#include <doctest/doctest.h>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/difference/picture_error.h"
#include "core/base/expect.h"
#include "tests/support/checked_floor.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::reference_test {
namespace {

using apps::PictureOptions;
using apps::Reference;
using apps::ReferenceOptions;

PictureOptions small_picture() {
  PictureOptions picture;
  picture.resolution = apps::Resolution{24, 16};
  return picture;
}

Reference reference(std::uint32_t samples_a_side, std::uint64_t seed = 1) {
  return apps::reference_for(mirrors_and_glass(), small_picture(), {.samples_a_side = samples_a_side, .seed = seed});
}

TEST_CASE("a reference says how far it is from one with many more samples") {
  const Reference rough = reference(4), fine = reference(24, 7);
  const double error = apps::measure_error(rough.picture, fine.picture).root_mean_square;
  CHECK(fine.own_error < rough.own_error / 3);
  CHECK(error > rough.own_error / 1.5);
  CHECK(error < rough.own_error * 1.5);
  const apps::Image none(rough.picture.width, rough.picture.height);
  CHECK(apps::measure_error(rough.difference, none).root_mean_square == doctest::Approx(rough.own_error));
}

TEST_CASE("a reference sees textures as they are, without cones") {
  PictureOptions picture = small_picture();
  const ReferenceOptions options{.samples_a_side = 8};
  const Reference painted = apps::reference_for(CheckedFloor::painted(), picture, options);
  const Reference laid = apps::reference_for(CheckedFloor::laid(), picture, options);
  CHECK(apps::measure_error(painted.picture, laid.picture).root_mean_square < 0.004);  // blurred by a texel
}

TEST_CASE("a stop ends a reference, and progress counts both its halves") {
  std::stop_source source;
  std::uint64_t last = 0, total = 0;
  const apps::Attendance watch{.progress = [&](std::uint64_t done, std::uint64_t all) { last = done, total = all; },
                               .stop = source.get_token()};
  apps::reference_for(mirrors_and_glass(), small_picture(), {.samples_a_side = 2}, watch);
  CHECK(last == 32);
  CHECK(total == 32);
  source.request_stop();
  CHECK_THROWS_AS(apps::reference_for(mirrors_and_glass(), small_picture(), {}, watch), apps::Interrupted);
}

TEST_CASE("samples that have no two halves are refused") {
  CHECK_THROWS_AS(reference(3), core::InternalError);
  CHECK_THROWS_AS(reference(0), core::InternalError);
}

}  // namespace
}  // namespace dmpc::tests::reference_test
