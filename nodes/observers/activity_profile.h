// The activity of every node over time, in a bounded number of steps; an instrument outside of the computer, whose memory is no
// node's.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/observer.h"

namespace dmpc::nodes {

/// The number of kinds of work. The maker of a profile classifies spans.
inline constexpr std::size_t work_count = 8;
/// The kind of work of a span. Called by several threads at a time.
using WorkOf = std::function<std::size_t(const Span& span)>;

/// Nanoseconds by kind of work.
using WorkTimes = std::array<std::uint64_t, work_count>;

/// The number of kinds of waits, by the packet that ends them.
inline constexpr std::size_t wait_count = 7;
using WaitOf = std::array<std::uint8_t, packet_kind_count>;
/// Nanoseconds by kind of wait.
using WaitTimes = std::array<std::uint64_t, wait_count>;

/// Steps of equal length from the start of the run.
struct ActivitySteps {
  std::uint64_t step_ns = 0, end_ns = 0;  ///< length of a step; end of the last span or wait of any node
  std::vector<std::vector<WorkTimes>>
      nodes;  ///< by number, the host last; each with all steps up to the last in which any was busy, or waited
  std::vector<std::vector<WaitTimes>> waits = {};  ///< likewise

  /// Of a step; the last ends with the run. Never 0.
  std::uint64_t length_ns(std::size_t step) const {
    const std::uint64_t begin_ns = step * step_ns;
    return end_ns > begin_ns ? std::min(step_ns, end_ns - begin_ns) : step_ns;
  }
};

/// Adds up the spans and waits of each node by time: a span's own duration is spread evenly over its length. Thread safety: as an
/// Observer; take() when the run is over.
class ActivityProfile final : public Observer {
 public:
  /// `peer_count` = nodes + host. A run has up to `step_count_max` steps, which is even, of a length that doubles as it goes on.
  ActivityProfile(std::uint32_t peer_count, WorkOf work_of, const WaitOf& wait_of = {}, std::size_t step_count_max = 128);
  ~ActivityProfile() override;

  void ended(const Span& span, const Program& program) override;
  void waited(const Waited& wait) override;

  /// What was observed, for add() of the profile of another rank.
  std::string bytes() const;
  /// Adds what was observed on another rank; its clock is near enough to this one's for steps.
  void add(std::string_view bytes);

  /// The result, all nodes in steps of the same length. Call it once.
  ActivitySteps take();

 private:
  struct Log;

  /// The node's log, with steps long enough for the time `end_ns`.
  Log& log_until(NodeId node, std::uint64_t end_ns);

  WorkOf work_of_;
  WaitOf wait_of_;
  std::size_t step_count_max_;
  std::vector<Log> logs_;
};

}  // namespace dmpc::nodes
