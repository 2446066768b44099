// Priced operations by class: counted by node programs and priced by a machine's model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/counts.h"

namespace dmpc::nodes {

/// The number of classes of operations. To the computer they are numbers with a price; their meaning is defined by the programs.
inline constexpr std::size_t charge_count = 13;

/// Operations of each class that a program has done since the start.
struct Charges {
  std::array<std::uint64_t, charge_count> count{};

  template <class Charge>
  requires std::is_enum_v<Charge> std::uint64_t& operator[](Charge charge) { return count[static_cast<std::size_t>(charge)]; }
  template <class Charge>
  requires std::is_enum_v<Charge> std::uint64_t operator[](Charge charge) const {
    return count[static_cast<std::size_t>(charge)];
  }

  Charges& operator+=(const Charges& more) { return core::add_counts(*this, more); }
};

/// A bit for each class of operations.
using ChargeBits = std::uint16_t;
static_assert(charge_count <= 16);

/// The classes whose counts differ between `before` and `after`.
inline ChargeBits charged_between(const Charges& before, const Charges& after) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < charge_count; ++i) {
    bits |= after.count[i] != before.count[i] ? 1U << i : 0U;
  }
  return static_cast<ChargeBits>(bits);
}

}  // namespace dmpc::nodes
