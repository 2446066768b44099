#include "apps/study_runs.h"

#include <doctest/doctest.h>

#include <string>

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
