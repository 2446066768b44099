// Decomposition of a node's virtual time into computing and losses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "nodes/observers/activity_profile.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::apps {

/// A strategy's packets by the kind of wait that they end.
struct WaitKinds {
  const char* data = "";           ///< what travels: "page" or "ray"
  std::uint32_t data_kinds = 0;    ///< bit set of the packets that bring data
  std::uint32_t work_kinds = 0;    ///< bit set of the packets that nodes without work exchange
  std::uint32_t token_kinds = 0;   ///< bit set of the packets that detect termination
  std::uint32_t credit_kinds = 0;  ///< bit set of the packets that return credits
  std::uint32_t film_kinds = 0;    ///< bit set of the packets for the film's pixels
  std::uint32_t end_kinds = 0;     ///< bit set of the packets that end a run
};

enum class TimePart : std::uint8_t {
  computing,     ///< the operations charged
  data_wait,     ///< idle until a page or rays arrived
  starvation,    ///< idle until work, or news of it, arrived
  token_wait,    ///< idle until the token of termination detection arrived
  credit_wait,   ///< idle until there were credits to send
  film_wait,     ///< idle until the host had taken pixels
  other_wait,    ///< idle until another packet arrived
  service_busy,  ///< service of interrupts while the node was not idle
  service_idle,  ///< service of interrupts while the node was idle
  messages,      ///< sending and receiving
  idle_at_end,   ///< idle after the last activity
};
inline constexpr std::size_t time_part_count = 11;
/// As keys of the counters.
inline constexpr std::array<const char*, time_part_count> time_part_names = {
    "computing",  "data_wait",    "starvation",   "token_wait", "credit_wait", "film_wait",
    "other_wait", "service_busy", "service_idle", "messages",   "idle_at_end"};

/// Shown names that other tables have, too.
inline constexpr std::string_view service_busy_words = "service while busy", service_idle_words = "service while idle";

/// The waits in the order in which a nodes::ActivityProfile numbers them for wait_of().
inline constexpr std::array<TimePart, nodes::wait_count> wait_parts = {
    TimePart::data_wait, TimePart::starvation, TimePart::token_wait, TimePart::credit_wait,
    TimePart::film_wait, TimePart::other_wait, TimePart::idle_at_end};
nodes::WaitOf wait_of(const WaitKinds& waits);

/// A time per TimePart. Thread-safe like any value.
struct TimeParts {
  std::array<std::uint64_t, time_part_count> ns{};

  std::uint64_t total_ns() const;
  /// Each part in percent of the total; they add up to 100. A run of no duration counts as computing.
  std::array<double, time_part_count> percent() const;
};

/// Shown names: "page wait".
std::string words_of(TimePart part, const WaitKinds& waits);

TimeParts parts_of(const nodes::VirtualTimes& times, const WaitKinds& waits);

/// Part by part.
void add_times(nodes::VirtualTimes& sum, const nodes::VirtualTimes& more);
/// Sum over the nodes without the host: their number times the length of the run.
nodes::VirtualTimes sum_of_nodes(const nodes::VirtualReport& report);

/// "computing 90.0 %, page wait 4.0 %, ...", without parts that are zero; the shown figures add up to 100 %.
std::string parts_text(const TimeParts& parts, const WaitKinds& waits);

}  // namespace dmpc::apps
