#include "nodes/observers/recorded_times.h"

#include <algorithm>
#include <bit>

namespace dmpc::nodes {

namespace {

constexpr std::uint32_t bits_max = 62;  ///< 146 years
constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

}  // namespace

RecordedTimes RecordedTimes::begin(std::uint64_t whole_until_ns, std::uint32_t period_bits) {
  return {.whole_until_ns = whole_until_ns,
          .whole_from_ns = never,
          .part_bits = period_bits,
          .period_bits = period_bits,
          .has_parts = true};
}

std::uint32_t RecordedTimes::period_bits_at(std::uint64_t now_ns) {
  return static_cast<std::uint32_t>(std::bit_width(now_ns / periods_min)) - (now_ns < periods_min ? 0 : 1);
}

std::uint64_t RecordedTimes::end_of_stretch(std::uint64_t time_ns) const {
  if (time_ns >= whole_from_ns) {
    return never;
  }
  const std::uint64_t end_of_part = has_parts ? (time_ns >> period_bits << period_bits) + part_ns() : 0;
  const std::uint64_t end = std::max(end_of_part > time_ns ? end_of_part : 0, time_ns < whole_until_ns ? whole_until_ns : 0);
  return end >= whole_from_ns ? never : end;
}

std::uint64_t RecordedTimes::next(std::uint64_t time_ns) const {
  return has_parts ? std::min(whole_from_ns, ((time_ns >> period_bits) + 1) << period_bits) : whole_from_ns;
}

void RecordedTimes::thin(std::uint64_t now_ns) {
  if (part_bits == 0 || now_ns >> period_bits >= 2 * periods_min) {
    period_bits = std::min(period_bits + 1, bits_max);
  } else {
    --part_bits;
  }
}

void RecordedTimes::meet(const RecordedTimes& other) {
  whole_until_ns = std::min(whole_until_ns, other.whole_until_ns);
  whole_from_ns = std::max(whole_from_ns, other.whole_from_ns);
  part_bits = std::min(part_bits, other.part_bits);
  period_bits = std::max(period_bits, other.period_bits);
  has_parts = has_parts && other.has_parts;
}

}  // namespace dmpc::nodes
