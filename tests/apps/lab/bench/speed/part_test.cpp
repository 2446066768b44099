#include "apps/lab/bench/speed/part.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::part_test {

using apps::SpeedPart;
using apps::SpeedSettings;

namespace {

using Words = std::vector<std::string>;

bool has(const Words& words, const std::string& word) { return std::find(words.begin(), words.end(), word) != words.end(); }

}  // namespace

TEST_CASE("parts are asked for by their names") {
  for (const SpeedPart part : apps::all_speed_parts()) {
    CHECK(apps::parse_speed_parts(apps::name_of(part)) == std::set{part});
  }
  CHECK(apps::parse_speed_parts("build,kernel,build") == std::set{SpeedPart::kernel, SpeedPart::build});
}

TEST_CASE("a part that is gone is answered with what tells the same") {
  for (const char* const part : {"kernel,load", "picture"}) {
    CHECK_THROWS_WITH_AS(apps::parse_speed_parts(part), doctest::Contains("dmpc render --stats=FILE says what"),
                         core::UsageError);
  }
}

TEST_CASE("thread counts are ascending without repetition") {
  CHECK(apps::parse_thread_counts("8,1,2,1") == std::vector<std::uint32_t>{1, 2, 8});
}

TEST_CASE("without scenes each part has its own, in haste none of a million triangles") {
  SpeedSettings settings;
  CHECK(settings.scenes_of(SpeedPart::kernel) == Words{"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9"});
  CHECK(has(settings.scenes_of(SpeedPart::build), "tetra-10"));
  CHECK(settings.scenes_of(SpeedPart::memory) == Words{"tetra-9", "tetra-10"});
  CHECK(settings.scenes_of(SpeedPart::pages).size() == 5);
  CHECK(settings.scenes_of(SpeedPart::plain).back() == "balls-2-t4");
  settings.is_quick = true;
  for (const SpeedPart part : apps::all_speed_parts()) {
    CHECK_FALSE(has(settings.scenes_of(part), "tetra-10"));
  }
  CHECK(settings.scenes_of(SpeedPart::plain) == Words{"teapot-12", "mount-6-t6", "rings-4-t1", "balls-2-t4"});
}

TEST_CASE("scenes that are given are those of all parts but pages, which the article must have") {
  SpeedSettings settings;
  settings.scenes = {"tetra-2", "tetra-10"};
  settings.is_quick = true;
  CHECK(settings.scenes_of(SpeedPart::memory) == settings.scenes);
  CHECK(settings.scenes_of(SpeedPart::pages) == Words{"tetra-10"});
}

TEST_CASE("rounds and pixels are the part's unless they are given") {
  SpeedSettings settings;
  CHECK(settings.rounds_of(SpeedPart::kernel) == 7);
  CHECK(settings.rounds_of(SpeedPart::build) == 3);
  CHECK(settings.picture_of(SpeedPart::emulation, "tetra-2").resolution->width == 1024);
  CHECK(settings.picture_of(SpeedPart::kernel, "tetra-2").resolution->height == 512);
  settings.is_quick = true;
  CHECK(settings.rounds_of(SpeedPart::kernel) == 3);
  CHECK(settings.rounds_of(SpeedPart::build) == 1);
  CHECK(settings.picture_of(SpeedPart::emulation, "tetra-2").resolution->width == 128);
  settings.rounds = 5;
  settings.resolution = {3, 4};
  CHECK(settings.rounds_of(SpeedPart::build) == 5);
  CHECK(settings.picture_of(SpeedPart::emulation, "tetra-2").resolution->height == 4);
}

}  // namespace dmpc::tests::part_test
