#include "apps/lab/bench/speed/part.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::part_test {

using apps::SpeedPart;
using apps::SpeedSettings;

namespace {

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("parts are asked for by their names") {
  for (const SpeedPart part : apps::all_speed_parts()) {
    CHECK(apps::parse_speed_parts(apps::name_of(part)) == std::set{part});
  }
  CHECK(apps::parse_speed_parts("plain,kernel,plain") == std::set{SpeedPart::kernel, SpeedPart::plain});
}

TEST_CASE("a part that is gone is answered with what tells the same") {
  CHECK_THROWS_WITH_AS(apps::parse_speed_parts("kernel,load"), doctest::Contains("dmpc render --stats=FILE says what"),
                       core::UsageError);
  CHECK_THROWS_WITH_AS(apps::parse_speed_parts("pages"), doctest::Contains("dmpc study paper has Table 2"), core::UsageError);
}

TEST_CASE("thread counts are ascending without repetition") {
  CHECK(apps::parse_thread_counts("8,1,2,1") == std::vector<std::uint32_t>{1, 2, 8});
}

TEST_CASE("without scenes each part has its own, and the plain renderer in haste none of a quarter of a million triangles") {
  SpeedSettings settings;
  CHECK(settings.scenes_of(SpeedPart::kernel) == Words{"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9"});
  CHECK(settings.scenes_of(SpeedPart::plain).back() == "lattice-12");
  settings.is_quick = true;
  CHECK(settings.scenes_of(SpeedPart::plain) ==
        Words{"teapot-12", "mount-6-t6", "rings-4-t1", "balls-2-t4", "jacks-3", "lattice-12"});
  settings.scenes = {"tetra-2", "tetra-9"};
  CHECK(settings.scenes_of(SpeedPart::plain) == settings.scenes);
}

TEST_CASE("rounds and pixels are the part's unless they are given") {
  SpeedSettings settings;
  CHECK(settings.rounds_of(SpeedPart::kernel) == 7);
  CHECK(settings.rounds_of(SpeedPart::paths) == 3);
  CHECK(settings.picture_of(SpeedPart::emulation, "tetra-2").resolution->width == 1024);
  CHECK(settings.picture_of(SpeedPart::kernel, "tetra-2").resolution->height == 512);
  settings.is_quick = true;
  CHECK(settings.rounds_of(SpeedPart::kernel) == 3);
  CHECK(settings.rounds_of(SpeedPart::paths) == 1);
  CHECK(settings.picture_of(SpeedPart::emulation, "tetra-2").resolution->width == 128);
  settings.rounds = 5;
  settings.resolution = {3, 4};
  CHECK(settings.rounds_of(SpeedPart::paths) == 5);
  CHECK(settings.picture_of(SpeedPart::emulation, "tetra-2").resolution->height == 4);
}

}  // namespace dmpc::tests::part_test
