// Selecting an emitter or a tile of the sky: the way of a number down a tree of choices.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>

#include "core/record/choice_node.h"

namespace dmpc::core {

/// What was selected, and a number for the point on it.
struct DrawnEmitter {
  std::uint32_t index = 0;
  float place = 0;  ///< below 1: uniform, whatever was selected

  static DrawnEmitter at(std::uint32_t index, double place) {
    return {index, std::min(static_cast<float>(place), 0x1.fffffep-1F)};
  }
};

/// A number on its way, which is stored in the same bytes as what it selects.
struct Choosing {
  std::uint32_t node = 0;  ///< 24 bits: skies have no more tiles
  double number = 0;       ///< in [0, 1), a multiple of 2^-40

  /// From two numbers that are multiples of 2^-32: one has too few digits for many choices.
  static Choosing of(double number, double more_digits) {
    return {0, number + static_cast<double>(static_cast<std::uint32_t>(more_digits * 0x1p8)) * 0x1p-40};
  }
  static Choosing from(const DrawnEmitter& stored) {
    const std::uint64_t bits = std::uint64_t{stored.index} << 32U | std::bit_cast<std::uint32_t>(stored.place);
    return {static_cast<std::uint32_t>(bits >> 40U), static_cast<double>(bits & 0xff'ffff'ffffU) * 0x1p-40};
  }
  DrawnEmitter stored() const {
    const std::uint64_t bits = std::uint64_t{node} << 40U | static_cast<std::uint64_t>(number * 0x1p40);
    return {static_cast<std::uint32_t>(bits >> 32U), std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
  }

  /// Reads the node of a tree of `count` choices, 2 or more. Returns what it selects; nothing if that is another node.
  std::optional<DrawnEmitter> step(const ChoiceNode& its, std::uint32_t count) {
    const ChoiceStep step = step_of(its, number);
    const std::uint32_t nodes = choice_node_count(count);
    node = node * choice_children + 1 + step.child;
    return node < nodes ? std::nullopt : std::optional(DrawnEmitter::at(node - nodes, step.place));
  }
};

/// What a number selects by a whole tree of `count` choices, 1 or more.
inline DrawnEmitter drawn_from(std::span<const ChoiceNode> tree, std::uint32_t count, double number, double more_digits) {
  Choosing at = Choosing::of(number, more_digits);
  std::optional<DrawnEmitter> drawn;
  while (count > 1 && !drawn) {
    drawn = at.step(tree[at.node], count);
  }
  return drawn.value_or(DrawnEmitter::at(0, number));
}

}  // namespace dmpc::core
