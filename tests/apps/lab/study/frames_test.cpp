#include "apps/lab/study/frames.h"

#include <doctest/doctest.h>

#include "tests/support/small_scenes.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::study_frames_test {

namespace {

using apps::FramesStudy;
using apps::Table;

FramesStudy study_of(double degrees) {
  return {.node_count = 3,
          .frame_count = 3,
          .turntable_degrees = degrees,
          .own_view = built_in("rings-2-t1").view,
          .bounds = {{-1, 5, -1}, {1, 9, 1}}};
}

constexpr std::size_t quarter = 0, share = 1, working_set = 2, all_kept = 3, rays = 4;

}  // namespace

TEST_CASE("frames has rows of pages with four caches, and one of rays, whose figures of faults are left open") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(1));
  REQUIRE(table.rows().size() == 5);
  CHECK(whole(table, quarter, "cache pages") < whole(table, share, "cache pages"));
  CHECK(real(table, share, "share of database") >= 40);
  CHECK(is_missing(table, rays, "faults cold"));
  CHECK(real(table, rays, "traffic cold") > 0);
  CHECK(subject.runs.film_hash().has_value());
}

TEST_CASE("a camera that stands still finds all that it fetched, where caches hold the working set; cold nodes fetch it anew") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(0));
  CHECK(real(table, all_kept, "faults cold") > 0);
  CHECK(real(table, all_kept, "faults warm") == 0);
  CHECK(real(table, all_kept, "warm faults") == 0);
  CHECK(real(table, rays, "traffic warm") == real(table, rays, "traffic cold"));
}

TEST_CASE("where all is kept a warm frame has no more faults than a cold one, and takes no longer") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(2));
  CHECK(real(table, all_kept, "faults warm") < real(table, all_kept, "faults cold"));
  CHECK(real(table, all_kept, "worst warm faults") < 100);
  CHECK(real(table, all_kept, "time warm") < real(table, all_kept, "time cold"));
  CHECK(real(table, working_set, "faults cold") >= real(table, all_kept, "faults cold"));
}

}  // namespace dmpc::tests::study_frames_test
