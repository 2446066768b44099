#include "apps/lab/study/studies.h"

#include <doctest/doctest.h>

#include "apps/frontend/machine/machines.h"
#include "tests/support/small_scenes.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::study_frames_test {

namespace {

using apps::FramesStudy;
using apps::Table;

FramesStudy study_of(double degrees) {
  const auto build_tree = [] {
    return apps::build_subject_quietly(built_in("rings-2-t1"), {.scene = "rings-2-t1", .resolution = apps::Resolution{32, 32}},
                                       apps::usual_database(apps::Strategy::forest));
  };
  return {.node_counts = {3},
          .frame_count = 3,
          .turntable_degrees = degrees,
          .own_view = built_in("rings-2-t1").view,
          .bounds = {{-1, 5, -1}, {1, 9, 1}},
          .build_tree = build_tree};
}

constexpr std::size_t quarter = 0, share = 1, working_set = 2, all_instanced = 3, questions = 4, rays = 5, what_travels = 6;

}  // namespace

TEST_CASE("frames has rows of pages with four caches, one of questions and one of rays, whose figures of faults are left open") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(1));
  REQUIRE(table.rows().size() == what_travels);
  CHECK(whole(table, quarter, "cache pages") < whole(table, share, "cache pages"));
  CHECK(real(table, share, "share of database") >= 40);
  for (const std::size_t row : {questions, rays}) {
    CHECK(is_missing(table, row, "faults cold"));
    CHECK(is_missing(table, row, "cache pages"));
    CHECK(real(table, row, "traffic cold") > 0);
  }
  CHECK(subject.runs.count() == what_travels);
}

TEST_CASE("a camera that stands still finds all that it fetched, where caches hold the working set; cold nodes fetch it anew") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(0));
  CHECK(real(table, all_instanced, "faults cold") > 0);
  CHECK(real(table, all_instanced, "faults warm") == 0);
  CHECK(real(table, all_instanced, "warm faults") == 0);
  CHECK(real(table, rays, "traffic warm") == real(table, rays, "traffic cold"));
}

TEST_CASE("questions leave nothing behind: warm nodes ask as many, in as long, as cold ones") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(3));
  CHECK(real(table, questions, "messages warm") == real(table, questions, "messages cold"));
  CHECK(real(table, questions, "traffic warm") == real(table, questions, "traffic cold"));
  CHECK(real(table, questions, "warm time") == 100);
}

TEST_CASE("where all is kept a warm frame has no more faults than a cold one, sends less, and takes no longer") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study_of(2));
  CHECK(real(table, all_instanced, "faults warm") < real(table, all_instanced, "faults cold"));
  CHECK(real(table, all_instanced, "worst warm faults") < 100);
  CHECK(real(table, all_instanced, "messages warm") < real(table, all_instanced, "messages cold"));
  CHECK(real(table, all_instanced, "time warm") < real(table, all_instanced, "time cold"));
  CHECK(real(table, working_set, "faults cold") >= real(table, all_instanced, "faults cold"));
}

TEST_CASE("single frames have rows that their means follow, and the first is as cold as it can be") {
  StudySubject subject("rings-2-t1");
  FramesStudy study = study_of(2);
  study.has_each_frame = true;
  const Table table = subject.measure(study);
  constexpr std::size_t rows_each = 4;  // three frames and their means
  REQUIRE(table.rows().size() == rows_each * what_travels);
  const std::size_t first = rows_each * all_instanced;
  CHECK(text(table, first, "frames") == "1");
  CHECK(text(table, first + 3, "frames") == "2 to 3");
  CHECK(real(table, first, "warm faults") == 100);
  CHECK(real(table, first, "faults warm") == real(table, first, "faults cold"));
  const double sum = real(table, first + 1, "faults warm") + real(table, first + 2, "faults warm");
  CHECK(real(table, first + 3, "faults warm") == sum / 2);
}

TEST_CASE("each machine and each number of nodes has its rows, and faults do not ask what the network costs") {
  StudySubject subject("rings-2-t1");
  FramesStudy study = study_of(1);
  study.node_counts = {2, 3};
  study.machines = {apps::find_machine_preset("ipsc2")->machine, apps::find_machine_preset("hdr")->machine};
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 4 * what_travels);
  CHECK(subject.runs.count() == 4 * what_travels);
  CHECK(text(table, 0, "machine") == "ipsc2");
  CHECK(whole(table, what_travels, "nodes") == 3);
  CHECK(text(table, 2 * what_travels, "machine") == "hdr");
  CHECK(real(table, all_instanced, "time warm") > 100 * real(table, 2 * what_travels + all_instanced, "time warm"));
  CHECK(contains(study.conclusion(table), "On 3 nodes of hdr a warm frame has of a cold one's faults "));
}

}  // namespace dmpc::tests::study_frames_test
