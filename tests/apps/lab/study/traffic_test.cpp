#include "apps/lab/study/studies.h"

#include <doctest/doctest.h>

#include "dataflow/packets.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::study_traffic_test {

namespace {

using apps::Table;
using apps::TrafficStudy;

std::uint64_t bytes_sent(const dataflow::Report& report, dataflow::Kind kind) {
  return report.sent()[dataflow::number_of(kind)].bytes;
}

}  // namespace

TEST_CASE("traffic has one row for each node count, from three runs") {
  const TrafficStudy study{.node_counts = {2, 3}};
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 2);
  CHECK(whole(table, 1, "nodes") == 3);
  CHECK(subject.runs.count() == 6);
}

TEST_CASE("with one node nothing travels") {
  const Table table = StudySubject("balls-1").measure(TrafficStudy{.node_counts = {1}});
  for (const char* const name : {"rays sent", "ray packets", "ray traffic", "faults", "page traffic"}) {
    CHECK_MESSAGE(whole(table, 0, name) == 0, name);
  }
  CHECK(real(table, 0, "hops a ray") == 0);
  CHECK(real(table, 0, "average load") == 100);
  CHECK(is_missing(table, 0, "packet fill"));
  CHECK(is_missing(table, 0, "overflow"));
}

TEST_CASE("the figures of rays do not contradict each other or the run") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(TrafficStudy{.node_counts = {4}});
  const dataflow::Report report = subject.runs.run("again", dataflow::RunOptions{.computer = {.node_count = 4}});
  const std::uint64_t rays = whole(table, 0, "rays sent");
  CHECK(rays == report.gathers().rays);
  CHECK(real(table, 0, "hops a ray") == report.messages_per_ray());
  CHECK(whole(table, 0, "ray packets") <= rays);
  CHECK(whole(table, 0, "ray traffic") >= rays * dataflow::ray_message_bytes(0));
  CHECK(bytes_sent(report, dataflow::Kind::rays) > 0);
  CHECK(real(table, 0, "packet fill") > 0);
  CHECK(real(table, 0, "packet fill") <= 100);
  CHECK(real(table, 0, "overflow") >= 0);
  CHECK(real(table, 0, "average load") == 100 * dataflow::average_load(report.work()));
  CHECK(real(table, 0, "average load") > real(table, 0, "average load equal size"));
  CHECK(whole(table, 0, "dataflow memory") == report.plan.node_memory_max_bytes());
}

TEST_CASE("the figures of pages are those of svm's own run") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(TrafficStudy{.node_counts = {2}});
  const svm::Report report = subject.runs.run("again", svm::RunOptions{.computer = {.node_count = 2}});
  CHECK(whole(table, 0, "faults") > 0);
  CHECK(whole(table, 0, "page traffic") >= whole(table, 0, "faults") * subject.subject.database.page_size());
  CHECK(whole(table, 0, "svm memory") == report.plan.node_memory_max_bytes());
}

TEST_CASE("no node count, no run") {
  StudySubject subject("balls-1");
  CHECK(subject.measure(TrafficStudy{.node_counts = {}}).rows().empty());
  CHECK(subject.runs.count() == 0);
}

}  // namespace dmpc::tests::study_traffic_test
