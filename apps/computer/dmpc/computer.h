// Programs for the emulated computer: what a program declares, what it can do on a node, and how it is run. The whole interface:
// this header needs no other of dmpc's.
//
// A computer has nodes 0 .. node_count - 1, each with a program of its own and a bounded memory, that share nothing and send each
// other packets. What is called here is plain sequential code: calls of one node's program never overlap.
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

/// Where a packet, an operation or a piece of memory stands in its list of Needs. Programs name them by an enum.
using Index = std::size_t;

/// The payload of a packet that is small: several of them lie in the place of one that is longer.
inline constexpr std::size_t small_bytes_max = 56;
/// The most packets that a program declares.
inline constexpr std::size_t packets_max = 24;
/// The most operations that a program declares.
inline constexpr std::size_t operations_max = 13;

/// What `count` values take of a node's memory: for MemoryNeed::bytes. More than can be addressed is the most that can.
template <class T>
constexpr std::size_t bytes_of(std::size_t count) {
  constexpr std::size_t most = SIZE_MAX / 64 * 64;
  return count > most / sizeof(T) ? most : (count * sizeof(T) + 63) / 64 * 64;
}

/// How many packets of a kind `source` may have under way to `target`, of `node_count` nodes. Called before the start, for all
/// pairs; a function of its arguments alone.
using Senders = std::function<std::uint32_t(std::uint32_t source, std::uint32_t target, std::uint32_t node_count)>;

/// Every node to every other.
Senders from_each_other(std::uint32_t count = 1);
/// Every node to the next one round the ring of all nodes, itself if it is alone.
Senders from_previous(std::uint32_t count = 1);
/// One node to every other.
Senders from_node(std::uint32_t source, std::uint32_t count = 1);
/// Every node to one, that one not to itself.
Senders to_node(std::uint32_t target, std::uint32_t count = 1);

/// A kind of packet. Either it has senders, or it is the answer to one that has.
struct PacketNeed {
  std::string name;                         ///< for counters and traces
  std::size_t bytes_max = small_bytes_max;  ///< payload's maximum
  /// The packets that may be sent. If this packet has an answer, the right to send returns with each answer; otherwise this is
  /// the number of packets that a node can send to another in a run.
  Senders senders = {};
  /// The name of the packet that it answers: its place is kept from the moment when that is sent.
  std::string answers = {};
};

/// A class of work with a price, for modelled machines.
struct OperationNeed {
  std::string name;
  /// On one core of today. A modelled machine takes as many times as long as it does for the other arithmetic it has a price for.
  double nanoseconds = 0;
};

/// What a node's program allocates under one name.
struct MemoryNeed {
  std::string name;
  std::size_t bytes = 0;  ///< as bytes_of() says, for each array
};

/// What a program takes of the computer. Mailboxes, credits and the plan of every node's memory are derived from it.
struct Needs {
  std::vector<PacketNeed> packets = {};
  std::vector<OperationNeed> operations = {};
  std::vector<MemoryNeed> memory = {};  ///< per node
};

/// A received packet: valid only during the call of Program::receive().
struct Packet {
  std::uint32_t source = 0;
  Index kind = 0;  ///< index in Needs::packets
  std::span<const std::byte> payload;

  /// The payload as a value. Throws ProgramError if it has another size.
  template <class T>
  T as() const;
  /// The payload as the values of an array. Throws ProgramError if it does not consist of whole ones.
  template <class T>
  void copy_to(std::span<T> target) const;
};

/// A program did what it may not, such as sending more than it declared. The run ends, and says it.
struct ProgramError : std::logic_error {
  using std::logic_error::logic_error;
};

/// All that a program can touch of the computer. Belongs to its program.
class Node {
 public:
  virtual std::uint32_t id() const = 0;
  virtual std::uint32_t node_count() const = 0;
  std::uint32_t next() const { return (id() + 1) % node_count(); }
  std::uint32_t previous() const { return (id() + node_count() - 1) % node_count(); }

  /// `count` zeros of the memory that is declared at `memory`. Only while the program is made. Throws ProgramError for more than
  /// was declared.
  template <class T>
  std::span<T> allocate(Index memory, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    return {reinterpret_cast<T*>(allocate_bytes(memory, bytes_of<T>(count))), count};
  }

  /// How many packets of this kind may be sent to `target` now.
  virtual std::uint32_t sendable(std::uint32_t target, Index packet) const = 0;
  /// Sends, if one more may be under way, else refuses: then go on with something else, and try again when an answer has come.
  /// Throws ProgramError for an answer, or a payload that is too long.
  [[nodiscard]] virtual bool try_send(std::uint32_t target, Index packet, std::span<const std::byte> payload) = 0;
  /// Sends values.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] bool try_send(std::uint32_t target, Index packet, std::span<T> values) {
    return try_send(target, packet, std::span<const std::byte>(std::as_bytes(values)));
  }
  /// Answers a packet that `target` sent and that is not answered yet: there is always room. Throws ProgramError if there is
  /// none.
  virtual void answer(std::uint32_t target, Index packet, std::span<const std::byte> payload = {}) = 0;

  /// Counts `count` operations, which take time on a modelled machine.
  virtual void charge(Index operation, std::uint64_t count = 1) = 0;

 protected:
  ~Node() = default;

 private:
  virtual std::byte* allocate_bytes(Index memory, std::size_t bytes) = 0;
};

/// What a node runs: never blocks, and touches nothing but its own state, its Node and what never changes.
class Program {
 public:
  virtual ~Program() = default;

  /// Takes a packet.
  virtual void receive(const Packet& packet) = 0;
  /// One bounded piece of work. Whether there is more to do without a packet coming first.
  virtual bool work() = 0;
  /// Whether it will neither work nor need a packet any more. The run ends when all have finished; if all stand still before, it
  /// is refused with what each one says of itself.
  virtual bool finished() const = 0;
  /// One line on where it is, for that.
  virtual std::string describe() const = 0;
};

/// An option of a program's own: a whole number.
struct NumberOption {
  std::string name;                ///< "--size"
  std::uint32_t* value = nullptr;  ///< its default, and what is given
  std::uint32_t least = 0, most = 0;
  std::string description;
};

/// What programs leave behind in the end: P::outcome() const, a value, or a span of values, without pointers. Of a program
/// without it: nothing. Asked for when other ranks wait: it is to be there, not to be worked out for long.
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

/// A program as its user meets it.
template <class P>
struct Application {
  std::string description;  ///< what it does, a sentence
  std::vector<NumberOption> options = {};
  /// The needs of `node_count` nodes. Called on every rank once the options are read. Throws UsageError for options that
  /// contradict each other.
  std::function<Needs(std::uint32_t node_count)> needs;
  /// A node's program, on the rank where the node is.
  std::function<std::unique_ptr<P>(Node&)> make = [](Node& node) { return std::make_unique<P>(node); };
  /// What the run came to, a line or several: printed, and a text in the file of --stats. What the nodes' programs left, in
  /// order, wherever they were.
  std::function<std::string(const std::vector<Outcome<P>>& outcomes)> result = {};
};

/// Options that do not go together, or not with the number of nodes.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An application with its programs' type erased; results are bytes.
struct AnyApplication {
  std::string description;
  std::vector<NumberOption> options;
  std::function<Needs(std::uint32_t)> needs;
  std::function<std::unique_ptr<Program>(Node&)> make;
  std::function<std::string(const Program&)> outcome;
  std::function<std::string(const std::vector<std::string>&)> result;
};
int run_any(int count, const char* const* words, const AnyApplication& application);

/// Reads the command line, whose options --help lists (nodes, runner, machine, chaos, counters, trace, report and those of the
/// program), runs the programs, prints what came of it, and returns the exit status of the process: 0 done, 1 bad input or an
/// output that cannot be written, 2 wrong usage, 3 an error of the program's or of dmpc's own, 4 not enough memory, 130
/// interrupted. Call it once, from main().
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
