// Threads that work side by side while they are timed.
#pragma once

#include <cstddef>
#include <functional>

namespace dmpc::apps {

/// Calls work(k) for each k below `count`, the last on the calling thread and each other one on a thread of its own, all at once.
/// Returns when all are over; rethrows the exception of the first k that has one.
void on_threads(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace dmpc::apps
