#include "dataflow/units/movement.h"

#include <algorithm>
#include <cstring>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"

namespace dmpc::dataflow {

Movement::Movement(nodes::Node& node, const Plan& plan, const Units& units) : node_(&node), units_(units) {
  std::tie(version_, pages_of_, rays_reported_, stale_, packet_) = layout(plan).in(node.memory());
  std::fill(stale_.begin(), stale_.end(), none);
}

nodes::Layout<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::byte> Movement::layout(const Plan& plan) {
  return {{core::MemoryUse::page_table, plan.unit_count()},
          {core::MemoryUse::page_table, plan.unit_count()},
          {core::MemoryUse::page_table, plan.node_count()},
          {core::MemoryUse::page_table, plan.node_count()},
          {nodes::Category::queues, plan.unit_packet_bytes()}};
}

void Movement::report_news(nodes::NodeId sender) {
  std::uint32_t& stale = stale_[nodes::index_of(sender)];
  if (stale != none) {
    send_control(*node_, sender, Kind::unit_moved,
                 UnitMoved{stale, version_[stale], nodes::index_of(units_.regions->owner_at(stale))});
    stale = none;
  }
}

bool Movement::receive(const nodes::Packet& packet) {
  switch (Kind{packet.kind}) {
    case Kind::unit_ask:
      take_ask(packet.source, packet.as<UnitAsk>());
      return true;
    case Kind::unit_refusal:
      take_refusal();
      return false;
    case Kind::unit_page:
      take_page(packet);
      return true;
    case Kind::unit_primaries:
      take_primaries(packet.source, packet.as<UnitPrimaryRays>());
      return true;
    default:
      core::expect(Kind{packet.kind} == Kind::unit_acknowledgement, "a packet of a transfer is a question or part of an answer");
      return take_acknowledgement();
  }
}

/// The node that has reported most primary rays, if this node has none left.
std::optional<nodes::NodeId> Movement::partner() const {
  const auto most = std::max_element(rays_reported_.begin(), rays_reported_.end());
  if (*most == 0 || !units_.primaries->empty() || units_.pages->free_frames() == 0) {
    return std::nullopt;
  }
  return nodes::NodeId{static_cast<std::uint32_t>(most - rays_reported_.begin())};
}

void Movement::ask() {
  const nodes::NodeId partner = *this->partner();
  migration_.ask();
  ++counters_.asks;
  rays_reported_[nodes::index_of(partner)] = 0;  // until its next report: a node that refuses is not asked again before others
  send_control(*node_, partner, Kind::unit_ask,
               UnitAsk{.free_frames = units_.pages->free_frames(),
                       .free_runs = static_cast<std::uint32_t>(units_.primaries->free_runs())});
}

/// The unit with most primary rays, if these are no more than the node would keep.
std::optional<std::uint32_t> Movement::unit_to_give() const {
  const UnitPrimaries& primaries = *units_.primaries;
  if (!migration_.may_give() || primaries.empty()) {
    return std::nullopt;
  }
  const std::uint32_t unit = primaries.largest_unit();
  core::expect(answers_for(unit), "a node has primary rays of its own units alone");
  return primaries.left_of(unit) <= primaries.left() / 2 ? std::optional(unit) : std::nullopt;
}

/// Traverses the unit's records once for many questions.
void Movement::mark(std::uint32_t unit) {
  if (marked_ != unit) {
    const UnitPages::Marked marked = units_.pages->mark(*units_.header, units_.regions->region_at(unit));
    counters_.records_walked += marked.records;
    pages_of_[unit] = marked.pages;
    marked_ = unit;
  }
}

/// Whether it has at least as many primary rays as pages, and the requester has memory for both.
bool Movement::is_worth_giving(std::uint32_t unit, const UnitAsk& ask) {
  if (pages_of_[unit] == 0) {
    mark(unit);
  }
  const std::uint32_t pages = pages_of_[unit];
  return pages > 0 && pages <= ask.free_frames && pages <= units_.primaries->left_of(unit) &&
         units_.primaries->runs_of(unit) <= ask.free_runs;
}

void Movement::take_ask(nodes::NodeId requester, const UnitAsk& ask) {
  const std::optional<std::uint32_t> unit = unit_to_give();
  if (!unit || !is_worth_giving(*unit, ask)) {
    return send_control(*node_, requester, Kind::unit_refusal, UnitRefusal{});
  }
  mark(*unit);
  migration_.give();
  recipient_ = requester;
  unit_ = *unit;
  pages_left_ = pages_of_[*unit];
  next_frame_ = 0;
  are_primaries_left_ = true;
  send_page();
}

void Movement::send_page() {
  const std::uint32_t frame = units_.pages->next_marked(next_frame_);
  next_frame_ = frame + 1;
  --pages_left_;
  ++counters_.pages_sent;
  const UnitPageHeader header{
      .unit = unit_, .version = version_[unit_] + 1, .page = units_.pages->page_at(frame), .is_last = pages_left_ == 0 ? 1U : 0U};
  const std::span<const std::byte> page = units_.pages->bytes_at(frame);
  std::memcpy(packet_.data(), &header, sizeof(header));
  std::memcpy(packet_.data() + sizeof(header), page.data(), page.size());
  node_->grant(recipient_, unit_channel);
  node_->send_reserved(recipient_, unit_channel, number_of(Kind::unit_page), std::span<const std::byte>(packet_));
}

/// Sends the rays that have not started in the meantime, if any.
void Movement::send_primaries() {
  UnitPrimaryRays rays{.unit = unit_};
  const std::uint64_t left = units_.primaries->left_of(unit_);
  rays.assigned = units_.primaries->give(unit_);
  are_primaries_left_ = units_.primaries->runs_of(unit_) > 0;
  rays.is_last = are_primaries_left_ ? 0 : 1;
  counters_.primaries_given += left - units_.primaries->left_of(unit_);
  node_->grant(recipient_, unit_channel);
  node_->send_reserved(recipient_, unit_channel, number_of(Kind::unit_primaries), rays);
}

void Movement::acknowledge(nodes::NodeId donor) {
  send_control(*node_, donor, Kind::unit_acknowledgement, UnitAcknowledgement{});
}

void Movement::take_refusal() {
  migration_.refused();
  ++counters_.refusals;
}

void Movement::take_page(const nodes::Packet& packet) {
  core::expect(packet.payload.size() == packet_.size(), "a page comes with its header");
  core::expect(!migration_.is_settled(), "a page comes to a node that has asked");
  const auto header = packet.front<UnitPageHeader>();
  const bool is_new = units_.pages->add(header.page, packet.payload.subspan(sizeof(header)));
  counters_.pages_installed += is_new ? 1 : 0;
  if (header.is_last != 0) {
    core::expect(is_news(version_[header.unit], header.version), "a unit is taken once from each that gives it");
    units_.regions->give_to(header.unit, node_->id());
    version_[header.unit] = header.version;
  }
  acknowledge(packet.source);
}

void Movement::take_primaries(nodes::NodeId donor, const UnitPrimaryRays& rays) {
  core::expect(answers_for(rays.unit), "primary rays come behind the pages of their unit");
  const std::uint64_t before = units_.primaries->left();
  units_.primaries->put(rays.unit, rays.assigned);
  counters_.primaries_taken += units_.primaries->left() - before;
  acknowledge(donor);
  if (rays.is_last != 0) {
    migration_.taken();
    migration_.rays_came();
  }
}

/// The recipient becomes responsible for the unit with its last page; primary rays follow.
bool Movement::take_acknowledgement() {
  if (pages_left_ > 0) {
    send_page();
    return true;
  }
  if (answers_for(unit_)) {
    units_.regions->give_to(unit_, recipient_);
    ++version_[unit_];
  }
  if (are_primaries_left_) {
    send_primaries();
    return true;
  }
  migration_.given();
  return false;
}

void Movement::take_news(const UnitMoved& moved) {
  // A node may learn who has a unit that it is giving away before the last acknowledgement arrives, which says the same.
  if (!answers_for(moved.unit) && is_news(version_[moved.unit], moved.version)) {
    core::expect(nodes::NodeId{moved.owner} != node_->id(), "a unit's owner knows all news of it");
    units_.regions->give_to(moved.unit, nodes::NodeId{moved.owner});
    version_[moved.unit] = moved.version;
  }
}

MovementCounters Movement::counters() const {
  MovementCounters counters = counters_;
  counters.units_given = migration_.given_count();
  counters.units_taken = migration_.taken_count();
  for (std::uint32_t unit = 0; unit < version_.size(); ++unit) {
    counters.units += answers_for(unit) ? 1 : 0;
  }
  return counters;
}

}  // namespace dmpc::dataflow
