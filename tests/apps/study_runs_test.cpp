#include "apps/study_runs.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/expect.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests {

namespace {

bool says(const StudySubject& subject, const std::string& words) {
  return subject.progress.str().find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("before the first run there is no film") {
  const StudySubject subject("balls-1");
  CHECK(subject.runs.count() == 0);
  CHECK_FALSE(subject.runs.film_hash());
}

TEST_CASE("runs of either strategy are counted, shown by number and name, and have one film") {
  StudySubject subject("balls-1");
  const dataflow::Report rays = subject.runs.run("three nodes", dataflow::RunOptions{.node_count = 3});
  const svm::Report pages = subject.runs.run("two nodes", svm::RunOptions{.node_count = 2});
  CHECK(rays.nodes.size() == 3);
  CHECK(pages.nodes.size() == 2);
  CHECK(subject.runs.count() == 2);
  CHECK(subject.runs.film_hash() == rays.film.hash());
  CHECK(subject.runs.film_hash() == pages.film.hash());
  CHECK(says(subject, "run 1 of 9, three nodes: "));
  CHECK(says(subject, "run 2 of 9, two nodes: "));
}

TEST_CASE("runs side by side are taken in their order and counted") {
  StudySubject subject("balls-1");
  std::vector<svm::RunOptions> runs;
  for (const std::uint32_t node_count : {5U, 1U, 3U, 2U}) {
    runs.push_back({.node_count = node_count, .machine = nodes::Machine()});
  }
  std::vector<std::size_t> nodes_of_runs;
  subject.runs.run_side_by_side(runs, [&](std::size_t index, const svm::Report& report) {
    CHECK(index == nodes_of_runs.size());
    nodes_of_runs.push_back(report.nodes.size());
  });
  CHECK(nodes_of_runs == std::vector<std::size_t>{5, 1, 3, 2});
  CHECK(subject.runs.count() == 4);
  CHECK(says(subject, "runs 1 to 4 of 9, side by side: "));
}

TEST_CASE("runs with threads are not run side by side, and no runs are none") {
  StudySubject subject("balls-1");
  const std::vector<svm::RunOptions> on_threads(1);
  const auto take = [](std::size_t, const svm::Report&) { throw core::InputError("taken"); };
  CHECK_THROWS_AS(subject.runs.run_side_by_side(on_threads, take), core::InternalError);
  subject.runs.run_side_by_side({}, take);
  CHECK(subject.runs.count() == 0);
}

TEST_CASE("a film unlike the first is a broken invariant") {
  StudySubject subject("balls-1");
  subject.runs.run("one node", svm::RunOptions{.node_count = 1});
  CHECK_THROWS_AS(subject.runs.compare(core::Film(32, 32)), core::InternalError);
}

TEST_CASE("a run that cannot be planned is not counted") {
  StudySubject subject("balls-1");
  CHECK_THROWS_AS(subject.runs.run("too small", svm::RunOptions{.node_memory_bytes = 1}), core::InputError);
  CHECK(subject.runs.count() == 0);
  CHECK_FALSE(subject.runs.film_hash());
}

}  // namespace dmpc::tests
