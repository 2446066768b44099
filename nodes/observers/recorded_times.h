// The times of a run that a trace has if there was not enough memory for all of them.
#pragma once

#include <cstdint>

namespace dmpc::nodes {

/// All before a time and all from another on; in between the same part of each period, or nothing. Parts and periods are powers
/// of two of nanoseconds since the start of the run, so that repeated thinning keeps a part of what was there, and all nodes have
/// the same without communication.
struct RecordedTimes {
  std::uint64_t whole_until_ns = 0;  ///< not included
  std::uint64_t whole_from_ns = 0;
  std::uint32_t part_bits = 0, period_bits = 0;  ///< the first 2^part_bits ns of each 2^period_bits
  bool has_parts = false;

  std::uint64_t part_ns() const { return std::uint64_t{1} << part_bits; }
  std::uint64_t period_ns() const { return std::uint64_t{1} << period_bits; }

  bool has(std::uint64_t time_ns) const {
    return time_ns < whole_until_ns || time_ns >= whole_from_ns || (has_parts && time_ns % period_ns() < part_ns());
  }
  /// The earliest end of the recorded stretch that contains `time_ns`.
  std::uint64_t end_of_stretch(std::uint64_t time_ns) const;
  /// The first recorded time after one that is not recorded.
  std::uint64_t next(std::uint64_t time_ns) const;
  /// Halves the recorded share of the time in between; `now_ns` is about the end of the run so far: by longer periods as long as
  /// there are at least `periods_min` of them, otherwise by shorter parts.
  void thin(std::uint64_t now_ns);
  /// Intersects it with the other.
  void meet(const RecordedTimes& other);

  /// So that a percent of any run has at least one part.
  static constexpr std::uint64_t periods_min = 128;
  /// The state before the first thinning: everything in between, in parts as long as their period.
  static RecordedTimes begin(std::uint64_t whole_until_ns, std::uint32_t period_bits);
  /// The argument of begin() at this time.
  static std::uint32_t period_bits_at(std::uint64_t now_ns);
};

}  // namespace dmpc::nodes
