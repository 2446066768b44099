// The interface between runners and strategies: an event-driven object that never blocks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/base/expect.h"
#include "nodes/charge.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// The fill level or progress of a program: a count at a moment. `name` lives as long as the program's code.
struct Level {
  std::string_view name;
  std::uint64_t value = 0;
};

/// A few levels, always the same ones in the same order for one program.
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

/// What a node runs. A runner calls it, never the reverse; a program cannot tell which runner does. Calls for one program never
/// overlap. A program may touch only its own state, its Node (send, local memory, charge, count) and immutable data made before
/// the start; it holds no reference into another node.
class Program {
 public:
  virtual ~Program() = default;

  /// Handles one packet. The payload is gone after the call.
  virtual void receive(const Packet& packet) = 0;

  /// One quantum: bounded, small. Returns whether there is more to do without a packet arriving first.
  virtual bool work() = 0;

  /// Called after a work() that had no more to do: whether there is something left that should rather wait for a packet that
  /// comes soon. If none comes, the program must not sleep: it does that in the next quantum.
  virtual bool has_leftovers() const { return false; }

  /// True once this program will neither work nor need to receive any more. The run ends when all programs are finished.
  virtual bool finished() const = 0;

  /// The operations done since the start, for runners that price them. Only ever grows.
  virtual Charges charges() const { return {}; }

  /// Its levels, for observers. Called only while the program is not running.
  virtual Levels levels() const { return {}; }

  /// One line on queues and state, for the watchdog's report. Called only while the program is not running.
  virtual std::string describe() const = 0;
};

/// The host's program if nodes need no host.
class IdleProgram final : public Program {
 public:
  void receive(const Packet& /*packet*/) override { core::expect(false, "nobody sends the host anything"); }
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return "nothing to do"; }
};

}  // namespace dmpc::nodes
