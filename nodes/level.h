// How full or how far a program is: what can be drawn over time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// A count at a moment. `name` lives as long as the program's code.
struct Level {
  std::string_view name;
  std::uint64_t value = 0;
};

/// A few of them, always the same ones in the same order of one program.
class Levels {
 public:
  static constexpr std::size_t count_max = 4;

  Levels() = default;
  Levels(std::initializer_list<Level> levels) {
    for (const Level& level : levels) {
      add(level);
    }
  }

  void add(const Level& level) {
    core::expect(count_ < count_max, "a program has few levels");
    levels_[count_++] = level;
  }

  const Level* begin() const { return levels_.data(); }
  const Level* end() const { return levels_.data() + count_; }

 private:
  std::array<Level, count_max> levels_;
  std::size_t count_ = 0;
};

}  // namespace dmpc::nodes
