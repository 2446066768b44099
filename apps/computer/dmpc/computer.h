// Programs for the emulated computer: what a program declares, what it can do on a node, and how it is run. This header is the
// whole interface and needs no other header of dmpc.
//
// A computer has nodes 0 .. node_count - 1. Each runs its own program in a bounded memory; nodes share nothing and communicate by
// packets. Programs are plain sequential code: calls of one node's program never overlap.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmpc {

/// The index of a packet, an operation or a piece of memory in its list of Needs. Programs name indices by an enum.
using Index = std::size_t;

/// The maximum payload of a small packet; several small packets fit in the slot of a larger one.
inline constexpr std::size_t small_bytes_max = 56;
/// The maximum number of packets that a program declares.
inline constexpr std::size_t packets_max = 24;
/// The maximum number of operations that a program declares.
inline constexpr std::size_t operations_max = 13;

/// Returns the bytes that `count` values take of a node's memory, for MemoryNeed::bytes; saturates at the largest size.
template <class T>
constexpr std::size_t bytes_of(std::size_t count) {
  constexpr std::size_t most = SIZE_MAX / 64 * 64;
  return count > most / sizeof(T) ? most : (count * sizeof(T) + 63) / 64 * 64;
}

/// Returns how many packets of a kind `source` may have in flight to `target`, of `node_count` nodes. Called before the start,
/// for all pairs; must depend only on its arguments.
using Senders = std::function<std::uint32_t(std::uint32_t source, std::uint32_t target, std::uint32_t node_count)>;

/// Every node sends to every other.
Senders from_each_other(std::uint32_t count = 1);
/// Every node sends to the next one on the ring of all nodes, or to itself if it is alone.
Senders from_previous(std::uint32_t count = 1);
/// One node sends to every other.
Senders from_node(std::uint32_t source, std::uint32_t count = 1);
/// Every other node sends to one.
Senders to_node(std::uint32_t target, std::uint32_t count = 1);

/// A kind of packet. It either has senders, or is the answer to one that has.
struct PacketNeed {
  std::string name;                         ///< for counters and traces
  std::size_t bytes_max = small_bytes_max;  ///< maximum payload
  /// The maximum number of packets in flight. If this packet has an answer, each answer returns the right to send; otherwise this
  /// is the number of packets that a node can send to another in a run.
  Senders senders = {};
  /// The name of the packet that it answers. Its slot is reserved when that packet is sent.
  std::string answers = {};
};

/// A class of work with a cost, for modelled machines.
struct OperationNeed {
  std::string name;
  /// On one core of today. A modelled machine scales it by its slowdown for the other arithmetic for which it has a price.
  double nanoseconds = 0;
};

/// Memory that a node's program allocates under one name.
struct MemoryNeed {
  std::string name;
  std::size_t bytes = 0;  ///< the sum of bytes_of() of its arrays
};

/// The resources that a program needs. Mailboxes, credits and the memory plan of every node are derived from it.
struct Needs {
  std::vector<PacketNeed> packets = {};
  std::vector<OperationNeed> operations = {};
  std::vector<MemoryNeed> memory = {};  ///< per node
};

/// A received packet, which is valid only during the call of Program::receive().
struct Packet {
  std::uint32_t source = 0;
  Index kind = 0;  ///< index in Needs::packets
  std::span<const std::byte> payload;

  /// Returns the payload as a value. Throws ProgramError if the size differs.
  template <class T>
  T as() const;
  /// Returns the payload as an array. Throws ProgramError if its size is not a multiple of the element size.
  template <class T>
  void copy_to(std::span<T> target) const;
};

/// A program violated the rules, for example by sending more than it declared. The run ends with this message.
struct ProgramError : std::logic_error {
  using std::logic_error::logic_error;
};

/// A program's interface to the computer. It belongs to its program.
class Node {
 public:
  virtual std::uint32_t id() const = 0;
  virtual std::uint32_t node_count() const = 0;
  std::uint32_t next() const { return (id() + 1) % node_count(); }
  std::uint32_t previous() const { return (id() + node_count() - 1) % node_count(); }

  /// Allocates `count` zeros from the declared memory, during construction only. Throws ProgramError beyond the declared size.
  template <class T>
  std::span<T> allocate(Index memory, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    return {reinterpret_cast<T*>(allocate_bytes(memory, bytes_of<T>(count))), count};
  }

  /// Returns how many packets of this kind may be sent to `target` now.
  virtual std::uint32_t sendable(std::uint32_t target, Index packet) const = 0;
  /// Sends if another packet may be in flight, else returns false; then do other work and retry after an answer has arrived.
  /// Throws ProgramError for an answer, or a payload that is too long.
  [[nodiscard]] virtual bool try_send(std::uint32_t target, Index packet, std::span<const std::byte> payload) = 0;
  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] bool try_send(std::uint32_t target, Index packet, std::span<T> values) {
    return try_send(target, packet, std::span<const std::byte>(std::as_bytes(values)));
  }
  /// Answers an unanswered packet from `target`, which always fits. Throws ProgramError if there is no such packet.
  virtual void answer(std::uint32_t target, Index packet, std::span<const std::byte> payload = {}) = 0;

  /// Counts `count` operations, which take time on a modelled machine.
  virtual void charge(Index operation, std::uint64_t count = 1) = 0;

 protected:
  ~Node() = default;

 private:
  virtual std::byte* allocate_bytes(Index memory, std::size_t bytes) = 0;
};

/// The code that a node runs. It never blocks, and accesses only its own state, its Node and immutable data.
class Program {
 public:
  virtual ~Program() = default;

  /// Processes a packet.
  virtual void receive(const Packet& packet) = 0;
  /// Does one bounded piece of work. Returns whether there is more to do before another packet arrives.
  virtual bool work() = 0;
  /// Returns whether the program will neither work nor need another packet. The run ends when all programs have finished. In a
  /// deadlock it fails with the description of each program.
  virtual bool finished() const = 0;
  /// Returns one line on the state, for deadlock messages.
  virtual std::string describe() const = 0;
};

/// A program's own option: a whole number.
struct NumberOption {
  std::string name;                ///< "--size"
  std::uint32_t* value = nullptr;  ///< the default, replaced by the given value
  std::uint32_t least = 0, most = 0;
  std::string description;
};

/// The result of a node's program: P::outcome() const returns a value or a span of values, without pointers. Programs without it
/// have none. It is called while other ranks wait, so it should return a stored result rather than compute for long.
template <class T>
struct OutcomeType {
  using Kept = T;
};
template <class T, std::size_t extent>
struct OutcomeType<std::span<T, extent>> {
  using Kept = std::vector<std::remove_const_t<T>>;
};
struct NoOutcome {};
template <class P>
auto outcome_of(const P& program) {
  if constexpr (requires { program.outcome(); }) {
    return program.outcome();
  } else {
    return NoOutcome{};
  }
}
template <class P>
using Outcome = typename OutcomeType<decltype(dmpc::outcome_of(std::declval<const P&>()))>::Kept;

/// A program and its user interface.
template <class P>
struct Application {
  std::string description;  ///< one sentence on what it does
  std::vector<NumberOption> options = {};
  /// Returns the needs on `node_count` nodes; called on every rank after the options are read. Throws UsageError for
  /// contradictory options.
  std::function<Needs(std::uint32_t node_count)> needs;
  /// Makes a node's program, on the node's rank.
  std::function<std::unique_ptr<P>(Node&)> make = [](Node& node) { return std::make_unique<P>(node); };
  /// Returns the result of the run in one or more lines, which are printed and stored in the file of --stats. `outcomes` are
  /// those of all nodes in order, on whatever rank they were.
  std::function<std::string(const std::vector<Outcome<P>>& outcomes)> result = {};
};

/// Options that are incompatible with each other or with the number of nodes.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An application with type-erased programs; results are bytes.
struct AnyApplication {
  std::string description;
  std::vector<NumberOption> options;
  std::function<Needs(std::uint32_t)> needs;
  std::function<std::unique_ptr<Program>(Node&)> make;
  std::function<std::string(const Program&)> outcome;
  std::function<std::string(const std::vector<std::string>&)> result;
};
int run_any(int count, const char* const* words, const AnyApplication& application);

/// Reads the command line (--help lists the options: nodes, runner, machine, chaos, counters, trace, report and those of the
/// program), runs the programs, prints the result, and returns the exit status of the process: 0 done, 1 bad input or an output
/// that cannot be written, 2 wrong usage, 3 an error of the program's or of dmpc's own, 4 not enough memory, 130 interrupted.
/// Call it once, from main().
template <class P>
int run(int count, const char* const* words, const Application<P>& application);

template <class T, std::size_t extent>
std::string bytes_of_outcome(std::span<T, extent> values) {
  static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_same_v<T, std::string_view>,
                "an outcome travels as bytes, perhaps to another process");
  return std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
std::string bytes_of_outcome(const T& value) {
  return bytes_of_outcome(std::span<const T>(&value, 1));
}
template <class T>
void take_outcome(const std::string& bytes, T& value) {
  std::memcpy(&value, bytes.data(), sizeof(T));
}
template <class T>
void take_outcome(const std::string& bytes, std::vector<T>& values) {
  values.resize(bytes.size() / sizeof(T));
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<char*>(values.data()));
}

template <class P>
int run(int count, const char* const* words, const Application<P>& application) {
  static_assert(std::is_base_of_v<Program, P>);
  const auto outcome = [](const Program& program) {
    return dmpc::bytes_of_outcome(dmpc::outcome_of(static_cast<const P&>(program)));
  };
  const auto result = [&](const std::vector<std::string>& all) {
    std::vector<Outcome<P>> outcomes;
    for (const std::string& bytes : all) {
      Outcome<P> of_node{};
      dmpc::take_outcome(bytes, of_node);
      outcomes.push_back(std::move(of_node));
    }
    return application.result ? application.result(outcomes) : std::string();
  };
  return run_any(count, words,
                 {application.description, application.options, application.needs, application.make, outcome, result});
}

template <class T>
T Packet::as() const {
  T value;
  copy_to(std::span(&value, 1));
  if (payload.size() != sizeof(T)) {
    throw ProgramError("a packet of " + std::to_string(payload.size()) + " bytes is taken for a value of " +
                       std::to_string(sizeof(T)));
  }
  return value;
}

template <class T>
void Packet::copy_to(std::span<T> target) const {
  static_assert(std::is_trivially_copyable_v<T>);
  if (payload.size() % sizeof(T) != 0 || payload.size() > target.size_bytes()) {
    throw ProgramError("a packet of " + std::to_string(payload.size()) + " bytes is copied to " + std::to_string(target.size()) +
                       " values of " + std::to_string(sizeof(T)));
  }
  std::memcpy(target.data(), payload.data(), payload.size());
}

}  // namespace dmpc
