// The clock of another rank relative to that of rank 0.
//
// Rank 0 asks for it, and assumes that it was read half-way between question and answer, which is wrong by at most half of the
// round trip. Of several round trips the shortest is the most accurate (F. Cristian, "Probabilistic clock synchronization",
// Distributed Computing 3, 1989).
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace dmpc::nodes {

/// The number of round trips, of which the shortest is used.
inline constexpr int clock_questions = 32;

/// One round trip: rank 0's clock at question and answer, and the other's in between.
struct ClockAnswer {
  std::uint64_t asked_ns = 0, reported_ns = 0, heard_ns = 0;

  std::uint64_t round_trip_ns() const { return heard_ns - asked_ns; }
  /// By rank 0's clock.
  std::uint64_t middle_ns() const { return asked_ns + round_trip_ns() / 2; }
  /// The other's clock minus rank 0's.
  std::int64_t offset_ns() const { return static_cast<std::int64_t>(reported_ns - middle_ns()); }
  /// The maximum error of that.
  std::uint64_t error_ns() const { return round_trip_ns() - round_trip_ns() / 2; }
};

/// Converts a rank's times of a run to rank 0's clock. Both count from the start of the run on rank 0, where the other was set to
/// rank 0's; between the measurements before and after the run the drift is assumed to be uniform.
class ClockDrift {
 public:
  /// The drift of rank 0 itself: none.
  ClockDrift() = default;
  /// `start_ns`: of the run, by rank 0's clock.
  ClockDrift(const ClockAnswer& before, const ClockAnswer& after, std::uint64_t start_ns)
      : before_ns_(static_cast<std::int64_t>(before.middle_ns() - start_ns)),
        after_ns_(static_cast<std::int64_t>(after.middle_ns() - start_ns)),
        gained_ns_(after.offset_ns() - before.offset_ns()),
        error_ns_(std::max(before.error_ns(), after.error_ns())) {}

  /// Converts a time of the other rank to rank 0's clock; not before the start.
  std::uint64_t corrected(std::uint64_t time_ns) const {
    const std::int64_t span_ns = after_ns_ + gained_ns_ - before_ns_;  // by the other's clock
    if (span_ns <= 0) {
      return time_ns;
    }
    const auto time = static_cast<std::int64_t>(time_ns);
    const double share = static_cast<double>(time - before_ns_) / static_cast<double>(span_ns);
    const auto gained = static_cast<std::int64_t>(share * static_cast<double>(gained_ns_));
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, time - gained));
  }
  /// The maximum error of a corrected time, if the drift is uniform.
  std::uint64_t error_ns() const { return error_ns_; }
  /// Between the two measurements.
  std::int64_t gained_ns() const { return gained_ns_; }

 private:
  std::int64_t before_ns_ = 0, after_ns_ = 0;
  std::int64_t gained_ns_ = 0;
  std::uint64_t error_ns_ = 0;
};
static_assert(std::is_trivially_copyable_v<ClockAnswer>);

}  // namespace dmpc::nodes
