#include "nodes/observers/wait_log.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace dmpc::nodes::wait_log_test {

namespace {

/// Waits of one node, one after the other, of so many nanoseconds.
WaitRecord kept(std::size_t node_waits_max, std::size_t count_max, std::initializer_list<std::uint64_t> lengths) {
  WaitLog log(2, node_waits_max);
  std::uint64_t at_ns = 0;
  for (const std::uint64_t length : lengths) {
    log.waited({.node = NodeId{1}, .begin_ns = at_ns, .end_ns = at_ns + length, .own_ns = length});
    at_ns += length + 1;
  }
  return log.take(count_max);
}

std::vector<std::uint64_t> lengths_of(const WaitRecord& record) {
  std::vector<std::uint64_t> lengths;
  for (const Waited& wait : record.waits) {
    lengths.push_back(wait.end_ns - wait.begin_ns);
  }
  return lengths;
}

using Lengths = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("a log with room has all waits, in their order") {
  const WaitRecord record = kept(4, 4, {3, 9, 1, 9});
  CHECK(lengths_of(record) == Lengths{3, 9, 1, 9});
  CHECK(record.count == 4);
  CHECK(record.left_out_ns_max == 0);
}

TEST_CASE("a full log keeps the longest half, and says how long those are at most that it lacks") {
  const WaitRecord record = kept(4, 4, {3, 9, 1, 8, 5, 5, 6});
  CHECK(lengths_of(record) == Lengths{9, 8, 6});
  CHECK(record.count == 7);
  CHECK(record.left_out_ns_max == 5);
}

TEST_CASE("of waits that are alike a log keeps the first") {
  const WaitRecord record = kept(8, 2, {7, 7, 7, 2});
  CHECK(lengths_of(record) == Lengths{7, 7});
  CHECK(record.waits.front().begin_ns == 0);
  CHECK(record.left_out_ns_max == 7);
}

TEST_CASE("a log without waits is empty") { CHECK(kept(2, 1, {}).waits.empty()); }

}  // namespace dmpc::nodes::wait_log_test
