#include "svm/replacement.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include "nodes/local_memory.h"

using namespace dmpc;
using svm::Replacement;
using svm::VictimChoice;

namespace {

using Pages = std::vector<std::uint32_t>;
constexpr std::uint32_t empty = 0xffffffffU;

/// Frames with pages, and a policy alone.
struct Frames {
  Frames(Replacement replacement, std::uint32_t count, std::uint32_t seed = 0)
      : memory(needs(replacement, count)), victims(memory, replacement, count, seed), stamps(count), pages(count, empty) {}
  static nodes::MemoryPlan needs(Replacement replacement, std::uint32_t count) {
    nodes::MemoryPlan plan;
    VictimChoice::add_needs(plan, replacement, count);
    return plan;
  }
  /// Returns whether it was a page hit.
  bool refer(std::uint32_t page) {
    auto place = std::find(pages.begin(), pages.end(), page);
    const bool is_hit = place != pages.end();
    if (!is_hit) {
      place = std::find(pages.begin(), pages.end(), empty);
      place = place != pages.end() ? place : pages.begin() + victims.victim(stamps);
    }
    *place = page;
    stamps[static_cast<std::size_t>(place - pages.begin())] = ++now;
    return is_hit;
  }
  std::uint32_t misses(const Pages& references) {
    std::uint32_t misses = 0;
    for (const std::uint32_t page : references) {
      misses += refer(page) ? 0 : 1;
    }
    return misses;
  }

  nodes::LocalMemory memory;
  VictimChoice victims;
  std::vector<std::uint64_t> stamps;
  Pages pages;
  std::uint64_t now = 0;
};

/// Belady, Nelson and Shedler, "An Anomaly in Space-Time Characteristics of Certain Programs Running in a Paging Machine" (1969).
const Pages anomaly = {1, 2, 3, 4, 1, 2, 5, 1, 2, 3, 4, 5};

}  // namespace

TEST_CASE("policies have names of their own") {
  std::set<std::string_view> names;
  for (const Replacement replacement : {Replacement::lru, Replacement::clock, Replacement::fifo, Replacement::random}) {
    CHECK(names.insert(svm::name_of(replacement)).second);
  }
}

TEST_CASE("fifo may miss more with more frames, lru never does") {
  CHECK(Frames(Replacement::fifo, 3).misses(anomaly) == 9);
  CHECK(Frames(Replacement::fifo, 4).misses(anomaly) == 10);
  CHECK(Frames(Replacement::lru, 3).misses(anomaly) == 10);
  CHECK(Frames(Replacement::lru, 4).misses(anomaly) == 8);
}

TEST_CASE("clock passes what was referenced, once, and takes what was not") {
  Frames frames(Replacement::clock, 3);
  frames.misses({1, 2, 3});
  frames.refer(4);  // all marked: the hand goes round and takes the first
  CHECK(frames.pages == Pages{4, 2, 3});
  frames.refer(2);
  frames.refer(5);  // 2 is marked again, 3 is not
  CHECK(frames.pages == Pages{4, 2, 5});
  frames.refer(6);  // 4 has a mark, 2 has lost its own
  CHECK(frames.pages == Pages{4, 6, 5});
}

TEST_CASE("random takes every frame about as often, the same ones for the same node, others for another") {
  constexpr std::uint32_t frame_count = 7;
  constexpr int draws = 70'000;
  Frames first(Replacement::random, frame_count, 3), same(Replacement::random, frame_count, 3),
      other(Replacement::random, frame_count, 4);
  std::vector<int> taken(frame_count);
  int agreements = 0;
  for (int i = 0; i < draws; ++i) {
    const std::uint32_t frame = first.victims.victim(first.stamps);
    REQUIRE(frame < frame_count);
    REQUIRE(same.victims.victim(same.stamps) == frame);
    agreements += other.victims.victim(other.stamps) == frame ? 1 : 0;
    ++taken[frame];
  }
  const double sigma = std::sqrt(draws / 7.0 * 6 / 7);
  for (const int count : taken) {
    CHECK(std::abs(count - draws / 7.0) < 5 * sigma);
  }
  CHECK(std::abs(agreements - draws / 7.0) < 5 * sigma);
}

TEST_CASE("every policy has one frame to choose from where there is one") {
  for (const Replacement replacement : {Replacement::lru, Replacement::clock, Replacement::fifo, Replacement::random}) {
    CHECK(Frames(replacement, 1).misses({1, 1, 2, 2, 1}) == 3);
  }
}

TEST_CASE("a policy takes exactly the memory that it says it needs, and all but lru none") {
  for (const Replacement replacement : {Replacement::lru, Replacement::clock, Replacement::fifo, Replacement::random}) {
    for (const std::uint32_t frames : {0U, 1U, 64U, 1000U}) {
      CHECK(Frames(replacement, frames).memory.used().bytes == Frames::needs(replacement, frames).bytes);
      CHECK((Frames::needs(replacement, frames).total() > 0) == (replacement == Replacement::lru && frames > 0));
    }
  }
}
