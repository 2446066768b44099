#include "svm/pages/replacement.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "core/base/expect.h"
#include "nodes/local_memory.h"

namespace replacement_test {

using namespace dmpc;
using svm::Replacement;

namespace {

using Pages = std::vector<std::uint32_t>;
constexpr std::uint32_t empty = 0xffffffffU;

std::vector<Replacement> all_policies() {
  std::vector<Replacement> all;
  for (std::size_t i = 0; i < svm::policy_kinds().size(); ++i) {
    all.push_back(static_cast<Replacement>(i));
  }
  return all;
}

/// Frames with pages, and a policy alone.
struct Frames {
  Frames(Replacement replacement, std::uint32_t count, std::uint32_t seed = 0)
      : kind(svm::kind_of(replacement)),
        memory(kind.layout(count)),
        stamps(count),
        pages(count, empty),
        names(count),
        policy(kind.make({memory, stamps, names, seed})) {}
  /// Returns whether it was a page hit.
  bool refer(std::uint32_t page) {
    auto place = std::find(pages.begin(), pages.end(), page);
    const bool is_hit = place != pages.end();
    if (!is_hit) {
      place = std::find(pages.begin(), pages.end(), empty);
      place = place != pages.end() ? place : pages.begin() + policy->victim(svm::PageId{page});
    }
    *place = page;
    const auto frame = static_cast<std::uint32_t>(place - pages.begin());
    names[frame] = svm::PageId{page};
    stamps[frame] = ++now;
    if (!is_hit) {
      policy->insert(names[frame], frame);
    } else if (kind.hears_hits) {
      policy->hit(names[frame], frame);
    }
    return is_hit;
  }
  std::uint32_t misses(const Pages& references) {
    std::uint32_t misses = 0;
    for (const std::uint32_t page : references) {
      misses += refer(page) ? 0 : 1;
    }
    return misses;
  }

  svm::PolicyKind kind;
  nodes::LocalMemory memory;
  std::vector<std::uint64_t> stamps;
  Pages pages;
  std::vector<svm::PageId> names;
  std::unique_ptr<svm::ReplacementPolicy> policy;
  std::uint64_t now = 0;
};

/// Belady, Nelson and Shedler, "An Anomaly in Space-Time Characteristics of Certain Programs Running in a Paging Machine" (1969).
const Pages anomaly = {1, 2, 3, 4, 1, 2, 5, 1, 2, 3, 4, 5};

}  // namespace

TEST_CASE("policies have names of their own") {
  std::set<std::string_view> names;
  for (const Replacement replacement : all_policies()) {
    CHECK(names.insert(svm::name_of(replacement)).second);
  }
}

TEST_CASE("fifo may miss more with more frames, lru never does") {
  CHECK(Frames(Replacement::fifo, 3).misses(anomaly) == 9);
  CHECK(Frames(Replacement::fifo, 4).misses(anomaly) == 10);
  CHECK(Frames(Replacement::lru, 3).misses(anomaly) == 10);
  CHECK(Frames(Replacement::lru, 4).misses(anomaly) == 8);
}

TEST_CASE("random takes every frame about as often, the same ones for the same node, others for another") {
  constexpr std::uint32_t frame_count = 7;
  constexpr int draws = 70'000;
  Frames first(Replacement::random, frame_count, 3), same(Replacement::random, frame_count, 3),
      other(Replacement::random, frame_count, 4);
  std::vector<int> taken(frame_count);
  int agreements = 0;
  for (int i = 0; i < draws; ++i) {
    const std::uint32_t frame = first.policy->victim(svm::PageId{9});
    REQUIRE(frame < frame_count);
    REQUIRE(same.policy->victim(svm::PageId{9}) == frame);
    agreements += other.policy->victim(svm::PageId{9}) == frame ? 1 : 0;
    ++taken[frame];
  }
  const double sigma = std::sqrt(draws / 7.0 * 6 / 7);
  for (const int count : taken) {
    CHECK(std::abs(count - draws / 7.0) < 5 * sigma);
  }
  CHECK(std::abs(agreements - draws / 7.0) < 5 * sigma);
}

TEST_CASE("a policy takes exactly the memory that it says it needs, and clock, fifo and random none") {
  for (const Replacement replacement : all_policies()) {
    for (const std::uint32_t frames : {0U, 1U, 64U, 1000U}) {
      CHECK(Frames(replacement, frames).memory.used().bytes == svm::kind_of(replacement).layout(frames).bytes);
      const bool takes_none =
          replacement == Replacement::clock || replacement == Replacement::fifo || replacement == Replacement::random;
      CHECK((takes_none || frames == 0 || svm::kind_of(replacement).layout(frames).total() > 0));
      CHECK((!takes_none || svm::kind_of(replacement).layout(frames).total() == 0));
    }
  }
}

TEST_CASE("a policy that is not there is a broken invariant") {
  CHECK_THROWS_AS(svm::name_of(static_cast<Replacement>(200)), core::InternalError);
}

}  // namespace replacement_test
