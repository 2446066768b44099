// Runs threads concurrently while they are timed.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <string>
#include <system_error>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

/// Calls work(k) for each k below `count`, each on its own thread. Returns when all have ended; rethrows the exception of the
/// lowest k that threw. Throws core::CapacityError if the computer does not let dmpc start the threads.
inline void on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::future<void>> crew;  // if one throws, the others are waited for
  try {
    while (crew.size() < count) {
      crew.push_back(std::async(std::launch::async, work, crew.size()));
    }
  } catch (const std::system_error&) {
    throw core::CapacityError("this takes " + std::to_string(count) + " threads, and this computer lets dmpc start only " +
                              std::to_string(crew.size()) + ": ask for a higher limit (ulimit -u, pids.max of a container)");
  }
  for (std::future<void>& one : crew) {
    one.get();
  }
}

}  // namespace dmpc::apps
