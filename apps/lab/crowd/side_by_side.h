// Independent pieces of work on the real computer's cores, several at a time.
#pragma once

#include <cstddef>
#include <functional>

namespace dmpc::apps {

/// Calls work(i) for each i below `count`, as many at a time as there are cores, begun in the order of i. What work(i) returns is
/// called afterwards: one at a time, in the order of i. Rethrows the first exception of either when those that had begun are
/// over; no other begins. Not for work that starts threads of its own.
void side_by_side(std::size_t count, const std::function<std::function<void()>(std::size_t)>& work);

}  // namespace dmpc::apps
