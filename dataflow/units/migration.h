// One node's part in the migration of units of space, as far as it concerns neither pages nor loads: the node program and the
// exhaustive model in tests/dataflow share these functions.
//
// An idle node asks one with more work, which refuses or sends the unit's pages one by one, each when the one before is
// acknowledged. The recipient is responsible for the unit from its last page on; the donor until that is acknowledged, so for a
// while both are: each has the pages, and no ray is sent to and fro. Pages are never dropped, so rays in flight in the unit end
// where they are. The unit's primary rays that have not started follow, in packets each of which is acknowledged, too.
//
// Why no ray is lost and forwarding ends: a node that is no longer responsible for a unit knows the recipient. Every migration
// has a greater version than the one before, and only newer information is used. So a ray that is forwarded goes to ever newer
// recipients, of which there are finitely many.
// Why nobody waits for ever: a node has one transfer in progress, as requester or as donor; a node that has one refuses at once,
// so there is no chain of waits. A node asks only once for all packets of rays that it has received meanwhile, and once for a
// unit that it has taken, whose primary rays were started before, by either node. So asking ends. Why the end is still detected
// (termination.h): a node that is about to ask is not passive, and every question, refusal, page, packet of primary rays and
// acknowledgement counts as a packet of rays, since its receiver may want to ask because of it. A transfer always has one of them
// in flight. News of recipients does not count: it makes nobody ask.
#pragma once

#include <cstdint>

#include "core/base/expect.h"

namespace dmpc::dataflow {

/// Belongs to one program.
class Migration {
 public:
  /// To be called for every packet of rays that arrives, and for primary rays that come with a unit.
  void rays_came() { have_rays_come_ = true; }

  /// Whether rays have come since the node asked last.
  bool have_rays_come() const { return have_rays_come_; }
  /// Whether the node may ask another for a unit.
  bool may_ask() const { return have_rays_come_ && role_ == Role::none; }
  void ask() {
    core::expect(may_ask(), "a node asks once for all rays received, and with no transfer under way");
    role_ = Role::asking;
    have_rays_come_ = false;
  }
  /// To be called when the node that was asked has refused.
  void refused() {
    core::expect(role_ == Role::asking, "who is refused has asked");
    role_ = Role::none;
  }
  /// To be called when the last packet of a unit has arrived.
  void taken() {
    core::expect(role_ == Role::asking, "who takes a unit has asked");
    role_ = Role::none;
    ++taken_count_;
  }

  /// Whether the node may give a unit to a requester: otherwise it refuses.
  bool may_give() const { return role_ == Role::none; }
  void give() {
    core::expect(may_give(), "a node has one transfer under way");
    role_ = Role::giving;
  }
  /// To be called when the last packet of the unit has been acknowledged.
  void given() {
    core::expect(role_ == Role::giving, "what is acknowledged was given");
    role_ = Role::none;
    ++given_count_;
  }

  /// Whether no transfer is in progress.
  bool is_settled() const { return role_ == Role::none; }
  std::uint64_t taken_count() const { return taken_count_; }
  std::uint64_t given_count() const { return given_count_; }

 private:
  enum class Role : std::uint8_t { none, asking, giving };

  Role role_ = Role::none;
  bool have_rays_come_ = false;
  std::uint64_t taken_count_ = 0, given_count_ = 0;
};

/// Whether information on a unit's recipient is newer than what is known.
constexpr bool is_news(std::uint32_t known_version, std::uint32_t version) { return version > known_version; }

}  // namespace dmpc::dataflow
