// What emulation costs whatever the nodes compute: a computer that does nothing but ask for pages and work on each.
#pragma once

#include <cstdint>

#include "apps/edge/run/runner_kind.h"
#include "apps/edge/system/stopwatch.h"

namespace dmpc::apps {

/// So much of everything: nodes, the items that each of them has under way and comes to in all, and the steps of an item's work.
struct QuestionRing {
  std::uint32_t node_count = 64;
  std::uint32_t items_in_flight = 16;
  std::uint32_t items_a_node = 1000;
  std::uint64_t steps = 0;

  std::uint64_t item_count() const { return std::uint64_t{node_count} * items_a_node; }
};

/// The work of an item: a chain of multiplications that nothing can shorten. Returns where it ends.
std::uint64_t work_on_item(std::uint64_t from, std::uint64_t steps);

/// What a step takes on this processor, now, in seconds of its thread's time.
double seconds_a_step();

/// Runs it on threads, a node each, or in a pool. Every item is a question, which some other node answers by 1 KiB, as a page of
/// svm comes, and its work. Throws core::InternalError if an item was lost.
Times times_of(const QuestionRing& ring, RunnerKind runner);

/// The same items' work one after the other, by one thread that asks nobody.
Times times_of_work_alone(const QuestionRing& ring);

}  // namespace dmpc::apps
