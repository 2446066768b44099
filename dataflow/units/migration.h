// One node's part in handing units of space over, as far as it decides nothing about pages or loads: the node program and the
// exhaustive model in tests/dataflow decide by the same functions.
//
// An idle node asks one with more work, which refuses or sends the unit's pages one by one, each when the one before is
// acknowledged. The recipient answers for the unit from its last page on; the donor until that is acknowledged, so for a while
// both do: each has the pages, and no ray is sent to and fro. Nobody gives pages up, so rays under way in the unit end where they
// are. The unit's primary rays that have not started follow, in packets each of which is acknowledged, too.
//
// Why no ray is lost and chases end: a node that answers no longer for a unit knows who took it. Every taking has a version
// greater than the one before, and newer news alone is believed. So a ray that is sent on goes to ever newer takers, and there
// are finitely many.
// Why nobody waits for ever: a node has one transfer under way, as requester or as donor; one that has refuses at once, so none
// waits for another that waits. A node asks only once for all packets of rays that it has received meanwhile, and once for a unit
// that it has taken, whose primary rays were started before, by either. So asking ends. Why the end is still proved
// (termination.h): a node that is about to ask is not passive, and every question, refusal, page, packet of primary rays and
// acknowledgement counts as a packet of rays, since it may make who receives it want to ask. A transfer has one of them under way
// all the time. News of takers does not count: it makes nobody ask.
#pragma once

#include <cstdint>

#include "core/base/expect.h"

namespace dmpc::dataflow {

/// Belongs to one program.
class Migration {
 public:
  /// Tell of every packet of rays that arrives, and of primary rays that come with a unit.
  void rays_came() { have_rays_come_ = true; }

  /// Since the node asked last.
  bool have_rays_come() const { return have_rays_come_; }
  /// The node may ask another for a unit.
  bool may_ask() const { return have_rays_come_ && role_ == Role::none; }
  void ask() {
    core::expect(may_ask(), "a node asks once for all rays received, and with no transfer under way");
    role_ = Role::asking;
    have_rays_come_ = false;
  }
  /// The node that was asked has refused.
  void refused() {
    core::expect(role_ == Role::asking, "who is refused has asked");
    role_ = Role::none;
  }
  /// The last of a unit has come.
  void taken() {
    core::expect(role_ == Role::asking, "who takes a unit has asked");
    role_ = Role::none;
    ++taken_count_;
  }

  /// The node may give a unit to one that asks: else it refuses.
  bool may_give() const { return role_ == Role::none; }
  void give() {
    core::expect(may_give(), "a node has one transfer under way");
    role_ = Role::giving;
  }
  /// The last of the unit has been acknowledged.
  void given() {
    core::expect(role_ == Role::giving, "what is acknowledged was given");
    role_ = Role::none;
    ++given_count_;
  }

  /// No transfer is under way.
  bool is_settled() const { return role_ == Role::none; }
  std::uint64_t taken_count() const { return taken_count_; }
  std::uint64_t given_count() const { return given_count_; }

 private:
  enum class Role : std::uint8_t { none, asking, giving };

  Role role_ = Role::none;
  bool have_rays_come_ = false;
  std::uint64_t taken_count_ = 0, given_count_ = 0;
};

/// Whether what is told of a unit's recipient is newer than what is known.
constexpr bool is_news(std::uint32_t known_version, std::uint32_t version) { return version > known_version; }

}  // namespace dmpc::dataflow
