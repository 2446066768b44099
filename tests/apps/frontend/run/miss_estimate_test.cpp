#include "apps/frontend/run/miss_estimate.h"

#include <doctest/doctest.h>

#include <vector>

namespace dmpc::apps::miss_estimate_test {

namespace {

/// So many pages, one after the other.
svm::ReferenceLog pages_up_to(std::uint32_t count, svm::ReferenceLog log) {
  for (std::uint32_t page = 0; page < count; ++page) {
    log.note(svm::PageId{page});
  }
  return log;
}

}  // namespace

TEST_CASE("of all references an estimate is exact, of all nodes together") {
  std::vector<svm::ReferenceLog> logs = {pages_up_to(64, {}), pages_up_to(32, {}), {}};
  const MissEstimate estimate = estimate_misses(logs);
  CHECK(estimate.every == 1);
  CHECK(estimate.misses(1) == 96);
  CHECK(estimate.misses(1000) == 96);
}

TEST_CASE("where one node keeps the references of a share of the pages, those of the same share of all nodes count") {
  std::vector<svm::ReferenceLog> logs = {pages_up_to(64, svm::ReferenceLog(8)), pages_up_to(64, {})};
  const std::size_t kept = logs[0].pages().size();
  const MissEstimate estimate = estimate_misses(logs);
  CHECK(estimate.every >= 8);
  CHECK(estimate.every == logs[0].every());
  CHECK(estimate.curve.references() == 2 * kept);
  CHECK(estimate.misses(1000) == static_cast<double>(2 * kept * estimate.every));
}

TEST_CASE("half of a sample is there to tell its error, and no half where every page counts") {
  std::vector<svm::ReferenceLog> sampled = {pages_up_to(4096, svm::ReferenceLog(1024))}, all = {pages_up_to(64, {})};
  const MissEstimate estimate = estimate_misses(sampled);
  CHECK(estimate.half.references() < estimate.curve.references());
  CHECK(estimate.half_misses(10'000) == static_cast<double>(estimate.half.references()) * 2 * estimate.every);
  CHECK(estimate.half_misses(10'000) == doctest::Approx(4096).epsilon(0.2));
  CHECK(sampled[0].pages().size() == estimate.curve.references());
  CHECK(estimate.cache_pages_min() == 4 * estimate.every);
  CHECK(estimate_misses(all).half.references() == 0);
  CHECK(estimate_misses(all).cache_pages_min() == 1);
}

TEST_CASE("nothing is missed by nobody") {
  std::vector<svm::ReferenceLog> none;
  CHECK(estimate_misses(none).misses(1) == 0);
}

TEST_CASE("each node keeps its part of the references, and not too few") {
  CHECK(references_of_node(4, 8192) == 2048);
  CHECK(references_of_node(1000, 8192) == 1024);
}

}  // namespace dmpc::apps::miss_estimate_test
