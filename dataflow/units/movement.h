// One node's part in moving regions: whom it asks for a unit, which it migrates, and the pages and primary rays on the way.
//
// Who, which and when: a node that rests, with no primary rays left, asks the one with most primary rays left that it has heard
// of, in packets of rays. That gives the unit with most of them, together with those of its primary rays that have not started,
// if they are at least as many as the unit's pages and at most half of all that it has left. So what is migrated is work to
// come, and no node gives more than it keeps. What other rules come to: RESULTS.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/record/record.h"
#include "core/trace/charge.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/regions/regions.h"
#include "dataflow/units/migration.h"
#include "dataflow/units/unit_pages.h"
#include "dataflow/units/unit_primaries.h"
#include "nodes/charge.h"
#include "nodes/layout.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// What a node counts of moving regions; all 0 where they do not move.
struct MovementCounters {
  std::uint64_t units_given = 0, units_taken = 0;
  std::uint64_t pages_sent = 0, pages_installed = 0;
  std::uint64_t records_walked = 0;                        ///< to find the pages of units that were asked for
  std::uint64_t primaries_given = 0, primaries_taken = 0;  ///< rays that had not started, with units
  std::uint64_t asks = 0, refusals = 0;                    ///< of this node, and how many of these were refused
  std::uint64_t rays_sent_on = 0;                          ///< that came though another answered for their unit by then
  std::uint64_t units = 0;                                 ///< that it answers for
};

/// Thread safety: belongs to one node.
class Movement {
 public:
  /// What is a node's own of the units; all of it outlives this.
  struct Units {
    const core::DatabaseHeader* header;  ///< the whole database's
    Regions* regions;
    UnitPages* pages;
    UnitPrimaries* primaries;
  };

  Movement(nodes::Node& node, const Plan& plan, const Units& units);
  /// What the constructor takes.
  static nodes::Layout<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::byte> layout(const Plan& plan);

  /// The node answers for a unit by what it knows.
  bool answers_for(std::uint32_t unit) const { return units_.regions->owner_at(unit) == node_->id(); }
  void rays_came() { migration_.rays_came(); }
  /// A node that sends rays tells how many primary rays it could migrate.
  void take_rays_left(nodes::NodeId sender, std::uint32_t count) { rays_reported_[nodes::index_of(sender)] = count; }
  std::uint32_t rays_left() const { return static_cast<std::uint32_t>(units_.primaries->left()); }

  /// A ray came from `sender` for a unit that is another's: that node is told with the next credits.
  void is_behind(nodes::NodeId sender, std::uint32_t unit) { stale_[nodes::index_of(sender)] = unit; }
  /// Tells `sender`, to which credits go, of one unit that has moved, if there is one to tell of.
  void report_news(nodes::NodeId sender);
  /// A ray goes on to another that answers for its unit by now.
  void sent_on() { ++counters_.rays_sent_on; }

  /// A resting node has someone to ask for a unit.
  bool wants_to_ask() const { return migration_.may_ask() && partner().has_value(); }
  void ask();
  bool is_settled() const { return migration_.is_settled(); }

  /// Takes a packet of a transfer, and says whether it has answered with another.
  bool receive(const nodes::Packet& packet);
  void take_news(const UnitMoved& moved);

  MovementCounters counters() const;
  /// What it costs beside messages: pages put into frames, and records that were read to find a unit's pages.
  void add_charges(nodes::Charges& charges) const {
    charges[core::Charge::page_install] += counters_.pages_installed;
    charges[core::Charge::bvh_node_read] += counters_.records_walked;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  std::optional<nodes::NodeId> partner() const;
  std::optional<std::uint32_t> unit_to_give() const;
  bool is_worth_giving(std::uint32_t unit, const UnitAsk& ask);
  void mark(std::uint32_t unit);
  void take_ask(nodes::NodeId requester, const UnitAsk& ask);
  void take_refusal();
  void take_page(const nodes::Packet& packet);
  void take_primaries(nodes::NodeId donor, const UnitPrimaryRays& rays);
  bool take_acknowledgement();
  void send_page();
  void send_primaries();
  void acknowledge(nodes::NodeId donor);

  nodes::Node* node_;
  Units units_;
  Migration migration_;
  std::span<std::uint32_t> version_;        ///< by unit: how often it had been taken when the owner that is known took it
  std::span<std::uint32_t> pages_of_;       ///< by unit: its pages, once they were looked for
  std::span<std::uint32_t> rays_reported_;  ///< primary rays left, by node
  std::span<std::uint32_t> stale_;          ///< by sending node: a unit to tell of, or none
  std::span<std::byte> packet_;             ///< where a page and its header are put together
  std::uint32_t marked_ = none;             ///< the unit whose pages are marked
  nodes::NodeId recipient_{};               ///< here and below: of the unit that is being given
  std::uint32_t unit_ = none, pages_left_ = 0, next_frame_ = 0;
  bool are_primaries_left_ = false;  ///< to be sent behind the last page
  MovementCounters counters_;
};

}  // namespace dmpc::dataflow
