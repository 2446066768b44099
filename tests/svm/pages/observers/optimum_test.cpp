#include "svm/pages/observers/optimum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "svm/pages/observers/miss_curve.h"
#include "tests/support/references.h"

namespace optimum_test {

using namespace dmpc;
using namespace dmpc::tests;
using svm::Optimum;
using svm::PageId;

namespace {

/// The fewest misses from `at` on, by trying every victim.
std::uint64_t fewest_misses(const References& references, std::size_t at, const std::set<PageId>& cached, std::size_t frames) {
  if (at == references.size()) {
    return 0;
  }
  if (cached.contains(references[at])) {
    return fewest_misses(references, at + 1, cached, frames);
  }
  std::set<PageId> after = cached;
  after.insert(references[at]);
  if (after.size() <= frames) {
    return 1 + fewest_misses(references, at + 1, after, frames);
  }
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  for (const PageId victim : cached) {
    std::set<PageId> without = after;
    without.erase(victim);
    fewest = std::min(fewest, 1 + fewest_misses(references, at + 1, without, frames));
  }
  return fewest;
}

/// Belady's rule without any cleverness: looks ahead for every cached page at every miss.
std::uint64_t misses_looking_ahead(const References& references, std::size_t frames) {
  std::vector<PageId> cached;
  std::uint64_t misses = 0;
  for (auto now = references.begin(); now != references.end(); ++now) {
    if (std::find(cached.begin(), cached.end(), *now) != cached.end()) {
      continue;
    }
    ++misses;
    if (cached.size() == frames) {
      const auto next_use = [&](PageId page) { return std::find(now, references.end(), page); };
      cached.erase(std::max_element(cached.begin(), cached.end(), [&](PageId a, PageId b) { return next_use(a) < next_use(b); }));
    }
    cached.push_back(*now);
  }
  return misses;
}

}  // namespace

TEST_CASE("the optimum of no references is no miss, of one page one") {
  CHECK(Optimum(References()).misses(0) == 0);
  CHECK(Optimum(References()).misses(3) == 0);
  const References one = references_of({7, 7, 7});
  CHECK(Optimum(one).misses(0) == 3);
  CHECK(Optimum(one).misses(1) == 1);
  CHECK(Optimum(one).misses(9) == 1);
}

TEST_CASE("the optimum of a sequence worked out by hand") {
  // Frames 3: miss 1 2 3, 4 for 3, hit 1 2, 5 for 4, hit 1 2, 3 for 1, 4 for 2 or 3, hit 5.
  const References references = references_of({1, 2, 3, 4, 1, 2, 5, 1, 2, 3, 4, 5});
  const Optimum optimum(references);
  CHECK(optimum.misses(1) == 12);
  CHECK(optimum.misses(3) == 7);
  CHECK(optimum.misses(4) == 6);
  CHECK(optimum.misses(5) == 5);
}

TEST_CASE("with one frame there is no choice") {
  const References references = random_references(4, 2000, 6);
  CHECK(Optimum(references).misses(1) == lru_misses(references, 1));
}

TEST_CASE("nobody who tries every victim finds fewer misses, and somebody finds as few") {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const References references = random_references(seed, 14, 6);
    const Optimum optimum(references);
    for (const std::uint32_t frames : {1U, 2U, 3U, 4U}) {
      CAPTURE(seed);
      CAPTURE(frames);
      CHECK(optimum.misses(frames) == fewest_misses(references, 0, {}, frames));
    }
  }
}

TEST_CASE("the optimum of many references is what looking ahead at every miss gives") {
  const References references = random_references(9, 12'000, 60);
  const Optimum optimum(references);
  for (const std::uint32_t frames : {2U, 9U, 30U, 50U}) {
    CAPTURE(frames);
    CHECK(optimum.misses(frames) == misses_looking_ahead(references, frames));
  }
}

TEST_CASE("the optimum never misses more than lru, nor more with more frames, nor less than each page once") {
  for (const std::uint32_t page_count : {3U, 100U, 3000U}) {
    const References references = random_references(page_count, 20'000, page_count);
    const svm::MissCurve lru(references);
    const Optimum optimum(references);
    std::uint64_t before = references.size();
    for (std::uint32_t frames = 1; frames <= 2 * page_count; frames += 1 + frames / 2) {
      const std::uint64_t misses = optimum.misses(frames);
      CHECK(misses <= lru.misses(frames));
      CHECK(misses <= before);
      CHECK(misses >= lru.cold_misses());
      before = misses;
    }
    CHECK(optimum.misses(page_count) == lru.cold_misses());
  }
}

}  // namespace optimum_test
