// What became of a node's virtual time: computing, and what was lost to everything else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "nodes/observers/activity_profile.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::apps {

/// Which waits are what, for a strategy.
struct WaitKinds {
  const char* data = "";           ///< what travels: "page" or "ray"
  std::uint32_t data_kinds = 0;    ///< a bit for each kind of packet that brings it
  std::uint32_t work_kinds = 0;    ///< a bit for each kind that nodes without work exchange
  std::uint32_t token_kinds = 0;   ///< a bit for each kind that goes round to find out whether all is done
  std::uint32_t credit_kinds = 0;  ///< a bit for each kind that says that there is room for a node's packets
  std::uint32_t film_kinds = 0;    ///< a bit for each kind that the film's pixels need
  std::uint32_t end_kinds = 0;     ///< a bit for each kind that ends a run
};

/// The parts of a time, in order.
enum class TimePart : std::uint8_t {
  computing,     ///< the operations charged
  data_wait,     ///< nothing to do until a page or rays came
  starvation,    ///< nothing to do until work, or word of it, came
  token_wait,    ///< nothing to do until the token came that finds out whether all is done
  credit_wait,   ///< nothing to do until there was room for what is to be sent
  film_wait,     ///< nothing to do until the host had taken pixels
  other_wait,    ///< nothing to do until another packet came
  service_busy,  ///< service of interrupts while there was something to do
  service_idle,  ///< and while there was nothing
  messages,      ///< sending and receiving
  idle_at_end,   ///< nothing to do any more
};
inline constexpr std::size_t time_part_count = 11;
/// As keys of the counters.
inline constexpr std::array<const char*, time_part_count> time_part_names = {
    "computing",  "data_wait",    "starvation",   "token_wait", "credit_wait", "film_wait",
    "other_wait", "service_busy", "service_idle", "messages",   "idle_at_end"};

/// The waits among them, in the order in which a nodes::ActivityProfile numbers them for wait_of().
inline constexpr std::array<TimePart, nodes::wait_count> wait_parts = {
    TimePart::data_wait, TimePart::starvation, TimePart::token_wait, TimePart::credit_wait,
    TimePart::film_wait, TimePart::other_wait, TimePart::idle_at_end};
nodes::WaitOf wait_of(const WaitKinds& waits);

/// A time by TimePart. Thread-safe like any value.
struct TimeParts {
  std::array<std::uint64_t, time_part_count> ns{};

  std::uint64_t total_ns() const;
  /// Each part in percent of the total; they add up to 100. A run that took no time was all computing.
  std::array<double, time_part_count> percent() const;
};

/// As people read them: "page wait".
std::string words_of(TimePart part, const WaitKinds& waits);

TimeParts parts_of(const nodes::VirtualTimes& times, const WaitKinds& waits);

/// Part by part.
void add_times(nodes::VirtualTimes& sum, const nodes::VirtualTimes& more);
/// Summed over the nodes without the host: their number times the length of the run.
nodes::VirtualTimes sum_of_nodes(const nodes::VirtualReport& report);

/// "computing 90.0 %, page wait 4.0 %, ...", without what is nothing; as they stand there the figures add up to 100 %.
std::string parts_text(const TimeParts& parts, const WaitKinds& waits);

}  // namespace dmpc::apps
