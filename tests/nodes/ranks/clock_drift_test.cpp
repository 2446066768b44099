#include "nodes/ranks/clock_drift.h"

#include <doctest/doctest.h>

#include <cstdint>

#include "core/base/sampling.h"

namespace dmpc::tests::clock_drift_test {
namespace {

using namespace nodes;

/// A clock beside rank 0's, and the way to it.
struct OtherClock {
  std::int64_t offset_ns = 0;
  double rate = 1;

  std::uint64_t at(std::uint64_t time_ns) const {
    return static_cast<std::uint64_t>(static_cast<double>(time_ns) * rate) + static_cast<std::uint64_t>(offset_ns);
  }
  ClockAnswer answer(std::uint64_t asked_ns, std::uint64_t there_ns, std::uint64_t back_ns) const {
    return {asked_ns, at(asked_ns + there_ns), asked_ns + there_ns + back_ns};
  }
};

std::int64_t difference(std::uint64_t a, std::uint64_t b) { return static_cast<std::int64_t>(a - b); }

}  // namespace

TEST_CASE("where both ways take as long, an offset is found to the nanosecond, ahead or behind") {
  for (const std::int64_t offset : {0L, 5'000'000'000L, -3'000L}) {
    CHECK(OtherClock{offset}.answer(10'000, 400, 400).offset_ns() == offset);
    CHECK(OtherClock{offset}.answer(10'000, 400, 400).error_ns() == 400);
  }
}

TEST_CASE("however uneven the ways are, an offset is wrong by half of the round trip at most") {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const std::uint64_t there = core::mix(seed) % 10'000, back = core::mix(seed + 1000) % 10'000;
    const ClockAnswer answer = OtherClock{77'000}.answer(1'000'000, there, back);
    CHECK(std::abs(answer.offset_ns() - 77'000) <= static_cast<std::int64_t>(answer.error_ns()));
  }
}

TEST_CASE("times of rank 0 are what they are") { CHECK(ClockDrift().corrected(123) == 123); }

TEST_CASE("a clock that gains evenly is corrected at both ends, between and beyond, and nothing is before the start") {
  constexpr std::uint64_t start = 1'000'000'000'000, end = start + 10'000'000'000;
  for (const double rate : {1.0, 1.0 + 1e-4, 1.0 - 1e-4}) {
    CAPTURE(rate);
    const OtherClock clock{12'345, rate};
    const ClockAnswer before = clock.answer(start - 5'000'000, 900, 900), after = clock.answer(end, 700, 700);
    const ClockDrift drift(before, after, start);
    CHECK(drift.error_ns() == 900);
    const std::uint64_t origin = start + static_cast<std::uint64_t>(before.offset_ns());  // what the rank was set to
    for (const std::uint64_t time : {start + 1'000'000, start + 5'000'000'000, end, end + 1'000'000}) {
      CHECK(std::abs(difference(drift.corrected(clock.at(time) - origin), time - start)) <= 2);
    }
    CHECK(drift.corrected(0) < 1000);
  }
}

}  // namespace dmpc::tests::clock_drift_test
