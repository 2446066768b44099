// One node's part in moving regions: the node that it asks for a unit, the units that it migrates, and pages and primary rays in
// flight.
//
// Policy: a resting node, with no primary rays left, asks the one with most primary rays left according to packets of rays. That
// gives the unit with most of them, together with those of its primary rays that have not started, if they are at least as many
// as the unit's pages and at most half of all that it has left. So what is migrated is future work, and no node gives more than
// it keeps. Results of other policies: RESULTS.md.
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

/// A node's counters of moving regions; all 0 if they do not move.
struct MovementCounters {
  std::uint64_t units_given = 0, units_taken = 0;
  std::uint64_t pages_sent = 0, pages_installed = 0;
  std::uint64_t records_walked = 0;                        ///< to find the pages of requested units
  std::uint64_t primaries_given = 0, primaries_taken = 0;  ///< rays that had not started, with units
  std::uint64_t asks = 0, refusals = 0;                    ///< by this node, and refusals of these
  std::uint64_t rays_sent_on = 0;  ///< rays forwarded because another node was responsible for their unit by then
  std::uint64_t units = 0;         ///< for which it is responsible
};

/// Thread safety: belongs to one node.
class Movement {
 public:
  /// A node's data of the units; all of it outlives this.
  struct Units {
    const core::DatabaseHeader* header;  ///< the whole database's
    Regions* regions;
    UnitPages* pages;
    UnitPrimaries* primaries;
  };

  Movement(nodes::Node& node, const Plan& plan, const Units& units);
  /// The memory that the constructor takes.
  static nodes::Layout<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::byte> layout(const Plan& plan);

  /// Whether the node is responsible for a unit, as far as it knows.
  bool answers_for(std::uint32_t unit) const { return units_.regions->owner_at(unit) == node_->id(); }
  void rays_came() { migration_.rays_came(); }
  /// To be called with a sending node's report of how many primary rays it could migrate.
  void take_rays_left(nodes::NodeId sender, std::uint32_t count) { rays_reported_[nodes::index_of(sender)] = count; }
  std::uint32_t rays_left() const { return static_cast<std::uint32_t>(units_.primaries->left()); }

  /// To be called for a ray from `sender` for a unit that is another's: that node is informed with the next credits.
  void is_behind(nodes::NodeId sender, std::uint32_t unit) { stale_[nodes::index_of(sender)] = unit; }
  /// Informs `sender`, before it gets credits, of one unit that has moved, if there is one.
  void report_news(nodes::NodeId sender);
  /// To be called when a ray is forwarded to the node that is responsible for its unit by now.
  void sent_on() { ++counters_.rays_sent_on; }

  /// Whether a resting node has another to ask for a unit.
  bool wants_to_ask() const { return migration_.may_ask() && partner().has_value(); }
  void ask();
  bool is_settled() const { return migration_.is_settled(); }

  /// Takes a packet of a transfer, and returns whether it has answered with another.
  bool receive(const nodes::Packet& packet);
  void take_news(const UnitMoved& moved);

  MovementCounters counters() const;
  /// Adds its costs apart from messages: pages put into frames, and records that were read to find a unit's pages.
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
  std::span<std::uint32_t> version_;        ///< by unit: number of migrations up to the known owner
  std::span<std::uint32_t> pages_of_;       ///< by unit: its number of pages, once they were searched
  std::span<std::uint32_t> rays_reported_;  ///< primary rays left, by node
  std::span<std::uint32_t> stale_;          ///< by sending node: a unit to be reported, or none
  std::span<std::byte> packet_;             ///< buffer in which a page and its header are put together
  std::uint32_t marked_ = none;             ///< the unit whose pages are marked
  nodes::NodeId recipient_{};               ///< here and below: for the unit that is being given
  std::uint32_t unit_ = none, pages_left_ = 0, next_frame_ = 0;
  bool are_primaries_left_ = false;  ///< to be sent after the last page
  MovementCounters counters_;
};

}  // namespace dmpc::dataflow
