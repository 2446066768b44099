// What an idle node does before it goes to sleep.
#pragma once

#include <cstddef>

namespace dmpc::nodes {

/// Looks at an empty mailbox, with a sched_yield before each, before one of so many threads goes to sleep. Where several share a
/// core, a yield that lets another one run costs less than a sleep and a wake-up, which take some microseconds (tens across
/// cores); more looks gain nothing. Where hardly two do, none of ours waits for the core, and on a machine that others use a
/// yield gives it away for milliseconds, while a sleeper gets it back soon after it is woken. `core_count` 0: not known.
constexpr int looks_before_sleep(std::size_t thread_count, std::size_t core_count) {
  constexpr int looks = 4;
  return thread_count > 2 * core_count + 1 ? looks : 0;
}

}  // namespace dmpc::nodes
