// Which times of a run a trace has that had no room for all of them.
#pragma once

#include <cstdint>
#include <limits>

namespace dmpc::nodes {

/// All before a time and all from another on; in between the same part of each period, or nothing. Parts and periods are powers
/// of two of nanoseconds since the start of the run, so that what is thinned again keeps a part of what it had, and everybody has
/// the same without asking.
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
  /// When what begins at a time that it has is over, at the earliest: all until then was recorded.
  std::uint64_t end_of_stretch(std::uint64_t time_ns) const;
  /// The first time that it has after one that it has not.
  std::uint64_t next(std::uint64_t time_ns) const;
  /// Halves how much of the time between it has, `now_ns` being about the end of the run as far as it has come: by longer periods
  /// as long as there are at least `periods_min` of them, else by shorter parts.
  void thin(std::uint64_t now_ns);
  /// Leaves what the other has, too.
  void meet(const RecordedTimes& other);

  /// A percent of any run has at least a part.
  static constexpr std::uint64_t periods_min = 128;
  /// Beginning to be thinned then: all that is between in parts that are as long as their period.
  static RecordedTimes begin(std::uint64_t whole_until_ns, std::uint32_t period_bits);
  /// For begin() at this time.
  static std::uint32_t period_bits_at(std::uint64_t now_ns);
};

}  // namespace dmpc::nodes
