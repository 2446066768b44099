// What every node was busy with over time, in a bounded number of steps: an instrument beside the computer, whose memory is no
// node's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/observer.h"

namespace dmpc::nodes {

/// How many kinds of work there are. Who makes a profile says which a span counts as.
inline constexpr std::size_t work_count = 6;
/// The number of a kind. Called by several threads at a time.
using WorkOf = std::function<std::size_t(const Span& span)>;

/// Nanoseconds by kind of work.
using WorkTimes = std::array<std::uint64_t, work_count>;

/// How many kinds of waits there are, and of which kind a wait is for a packet.
inline constexpr std::size_t wait_count = 7;
using WaitOf = std::array<std::uint8_t, packet_kind_count>;
/// Nanoseconds by kind of wait.
using WaitTimes = std::array<std::uint64_t, wait_count>;

/// Steps of equal length from the start of the run.
struct ActivitySteps {
  std::uint64_t step_ns = 0;
  std::vector<std::vector<WorkTimes>>
      nodes;  ///< by number, the host last; each of all steps up to the last in which any was busy, or waited
  std::vector<std::vector<WaitTimes>> waits = {};  ///< likewise
};

/// Adds up the spans and waits of each node by time: what one takes by itself is spread evenly over its length. Thread safety: as
/// an Observer; take() when the run is over.
class ActivityProfile final : public Observer {
 public:
  /// `peer_count` = nodes + host. A run has up to `step_count_max` steps, which is even, of a length that doubles as it goes on.
  ActivityProfile(std::uint32_t peer_count, WorkOf work_of, const WaitOf& wait_of = {}, std::size_t step_count_max = 128);
  ~ActivityProfile() override;

  void ended(const Span& span, const Program& program) override;
  void waited(const Waited& wait) override;

  /// What was seen of nodes, for add() of the profile of another rank.
  std::string bytes() const;
  /// Takes over what was seen of nodes that are on another rank; its clock is near enough to this one's for steps.
  void add(std::string_view bytes);

  /// What was seen, all nodes in steps of the same length. Call it once.
  ActivitySteps take();

 private:
  struct Log;

  /// Of the node, with steps so long that there are few enough until then.
  Log& log_until(NodeId node, std::uint64_t end_ns);

  WorkOf work_of_;
  WaitOf wait_of_;
  std::size_t step_count_max_;
  std::vector<Log> logs_;
};

}  // namespace dmpc::nodes
