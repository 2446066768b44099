// A node's part in throttling primary rays: its announcements, their recipients, and what it forwards of others' announcements.
#pragma once

#include <cstdint>

#include "core/base/expect.h"
#include "dataflow/backpressure.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/termination.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// Backpressure with its packets. Thread safety: belongs to one node.
class Throttling : public Backpressure {
 public:
  Throttling(nodes::Node& node, const Plan& plan)
      : Backpressure(plan.shares_slots() ? 1 : plan.node_count() - 1, plan.queue_packets,
                     !plan.request.rays.without_backpressure),
        node_(&node),
        host_(plan.host()),
        tells_host_alone_(plan.shares_slots()),
        place_(TerminationTree{plan.node_count()}.place_of(node.id())) {}

  /// Announces with `queued` packets in the queue. Requires is_due().
  void announce(std::uint32_t queued) {
    const Throttle throttle{Backpressure::announce(queued) ? 1U : 0U};
    if (tells_host_alone_) {
      return send_control(*node_, host_, Kind::throttle, throttle);
    }
    for (std::uint32_t i = 0; i < nodes::index_of(host_); ++i) {
      if (nodes::NodeId{i} != node_->id()) {
        send_control(*node_, nodes::NodeId{i}, Kind::throttle, throttle);
      }
    }
  }

  /// If the host relays it, those below are informed before the parent gets its answer.
  void take(nodes::NodeId teller, const Throttle& throttle) {
    Backpressure::take(throttle.holds != 0);
    untold_below_ = tells_host_alone_ ? place_.child_count : 0;
    if (untold_below_ == 0) {
      return send_control(*node_, teller, Kind::throttle_acknowledgement, ThrottleAcknowledgement{});
    }
    notify_children(*node_, place_, Kind::throttle, throttle);
  }

  void acknowledged(nodes::NodeId by) {
    if (!tells_host_alone_ || by == host_) {
      return Backpressure::acknowledged();
    }
    core::expect(untold_below_ > 0, "an acknowledgement answers what was relayed");
    if (--untold_below_ == 0) {
      send_control(*node_, place_.parent, Kind::throttle_acknowledgement, ThrottleAcknowledgement{});
    }
  }

 private:
  nodes::Node* node_;
  nodes::NodeId host_;
  bool tells_host_alone_;
  TreePlace place_;
  std::uint32_t untold_below_ = 0;  ///< members below that have not acknowledged the request to throttle
};

}  // namespace dmpc::dataflow
