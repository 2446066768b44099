// The costs of each item of a program's work, for the requested kinds; an instrument outside of the computer, whose memory is no
// node's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/ranks/clock_drift.h"

namespace dmpc::nodes {

/// The number of kinds of numbers of a map.
inline constexpr std::size_t heat_kind_count = 9;

/// A kind, in the numbering of the map's maker.
class HeatNumber {
 public:
  explicit constexpr HeatNumber(std::size_t value) : value_(value) {}
  // Implicit: the name of a kind is its number.
  template <class Kind>
  requires std::is_enum_v<Kind>
  constexpr HeatNumber(Kind kind) : value_(static_cast<std::size_t>(kind)) {}

  constexpr std::size_t value() const { return value_; }

 private:
  std::size_t value_;
};

/// Kinds that can be recorded. The computer defines four of them, and the program counts the others.
template <class Kind>
concept HeatKinds = std::is_enum_v<Kind> && requires {
  Kind::time;   // picoseconds of computing
  Kind::node;   // number of the node that the item belongs to
  Kind::depth;  // depth of the deepest Worked
  Kind::done;   // nanoseconds from the start until it was last processed (DoneObserver)
};

/// A number for each item and recorded kind; other kinds are dropped. Thread safety: several nodes may write at a time, even to
/// one item; read when none does.
class HeatMap {
 public:
  /// All zero. A kind may occur twice.
  template <class Kinds>
  requires HeatKinds<typename Kinds::value_type> HeatMap(std::uint32_t item_count, const Kinds& kinds)
      : item_count_(item_count),
        time_(Kinds::value_type::time),
        node_(Kinds::value_type::node),
        depth_(Kinds::value_type::depth),
        done_(Kinds::value_type::done) {
    for (const HeatNumber kind : kinds) {
      values_.at(kind.value()).resize(item_count);
    }
  }

  bool has(HeatNumber kind) const { return !values(kind).empty(); }
  std::uint32_t item_count() const { return item_count_; }
  HeatNumber time() const { return time_; }
  HeatNumber node() const { return node_; }
  HeatNumber depth() const { return depth_; }
  HeatNumber done() const { return done_; }

  /// All zero again.
  void clear();

  // These ignore a kind that is not recorded. They require item < item_count().
  void add(HeatNumber kind, std::uint32_t item, std::uint64_t amount);
  /// Raises it to at least `value`.
  void raise(HeatNumber kind, std::uint32_t item, std::uint64_t value);
  void set(HeatNumber kind, std::uint32_t item, std::uint64_t value);

  /// By item; empty if the kind is not recorded.
  std::span<const std::uint64_t> values(HeatNumber kind) const { return values_.at(kind.value()); }
  std::uint64_t sum(HeatNumber kind) const;

  /// All numbers, for add() of a map with the same items and kinds.
  std::string bytes() const;
  /// Adds the numbers of another rank's map; for depth, node and done the larger number remains, for done by this rank's clock.
  void add(std::string_view bytes, const ClockDrift& clock = {});

 private:
  /// The item's number; nullptr if the kind is not recorded.
  std::uint64_t* place(HeatNumber kind, std::uint32_t item);

  std::uint32_t item_count_;
  HeatNumber time_, node_, depth_, done_;
  std::array<std::vector<std::uint64_t>, heat_kind_count> values_;  ///< by kind
};

}  // namespace dmpc::nodes
