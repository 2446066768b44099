#include "nodes/observers/recorded_times.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>

namespace dmpc::nodes::watch_recorded_times_test {

namespace {

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

/// Before 10 and from 100 on, in between the first 4 of each 16.
constexpr RecordedTimes some = {.whole_until_ns = 10, .whole_from_ns = 100, .part_bits = 2, .period_bits = 4, .has_parts = true};

/// How many nanoseconds of these a trace has.
std::uint64_t count(const RecordedTimes& times, std::uint64_t from_ns, std::uint64_t to_ns) {
  std::uint64_t count = 0;
  for (std::uint64_t time_ns = from_ns; time_ns < to_ns; ++time_ns) {
    count += times.has(time_ns) ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("beginning and end are whole, and in between each period has its part") {
  CHECK(count(some, 0, 10) == 10);
  CHECK(count(some, 10, 16) == 0);
  CHECK(count(some, 16, 20) == 4);
  CHECK(count(some, 20, 32) == 0);
  CHECK(count(some, 32, 96) == 16);
  CHECK(count(some, 100, 200) == 100);
  CHECK(count({}, 0, 1000) == 1000);
  CHECK(count({.whole_from_ns = 900}, 0, 1000) == 100);
}

TEST_CASE("what is not there ends with the next part, or where all is whole") {
  CHECK(some.next(10) == 16);
  CHECK(some.next(31) == 32);
  CHECK(some.next(84) == 96);
  CHECK(some.next(99) == 100);
  CHECK(RecordedTimes{.whole_from_ns = 900}.next(0) == 900);
}

TEST_CASE("a stretch ends where its part does, or the beginning, or never") {
  CHECK(some.end_of_stretch(3) == 10);
  CHECK(some.end_of_stretch(17) == 20);
  CHECK(some.end_of_stretch(96) == never);  // the part goes on into the end
  CHECK(some.end_of_stretch(100) == never);
}

TEST_CASE("thinning leaves half of what is between, and nothing that was not there") {
  RecordedTimes times = RecordedTimes::begin(0, 3);
  std::uint64_t there = 1 << 14;
  CHECK(count(times, 0, there) == there);
  for (int i = 0; i < 8; ++i) {
    const RecordedTimes before = times;
    times.thin(1 << 14);
    CHECK(count(times, 0, 1 << 14) == there / 2);
    there /= 2;
    for (std::uint64_t time_ns = 0; time_ns < 1 << 14; ++time_ns) {
      CHECK((before.has(time_ns) || !times.has(time_ns)));
    }
  }
}

TEST_CASE("a percent of a run of any length has a part, however often it is thinned") {
  for (std::uint64_t end_ns = 1000; end_ns < 1'000'000'000'000; end_ns = 3 * end_ns + 7) {
    CAPTURE(end_ns);
    const std::uint32_t bits = RecordedTimes::period_bits_at(end_ns);
    RecordedTimes times = RecordedTimes::begin(0, bits);
    for (std::uint64_t now_ns = end_ns; now_ns < 1000 * end_ns; now_ns += end_ns) {
      times.thin(now_ns);
      CHECK((times.part_ns() == 1 || times.period_ns() <= now_ns / 100));
    }
  }
}

TEST_CASE("what two have in common both have") {
  const RecordedTimes other = {.whole_until_ns = 30, .whole_from_ns = 70, .part_bits = 1, .period_bits = 3, .has_parts = true};
  RecordedTimes both = some;
  both.meet(other);
  CHECK(count(both, 0, 200) > 100);
  for (std::uint64_t time_ns = 0; time_ns < 200; ++time_ns) {
    CHECK((!both.has(time_ns) || (some.has(time_ns) && other.has(time_ns))));
  }
}

}  // namespace dmpc::nodes::watch_recorded_times_test
