// Independent pieces of work on the real computer's cores, several at a time.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <utility>

namespace dmpc::apps {

/// Calls work(i) for each i below `count`, as many at a time as there are cores, begun in the order of i. What work(i) returns is
/// called afterwards: one at a time, in the order of i. Rethrows the first exception of either when those that had begun are
/// over; no other begins. Not for work that starts threads of its own.
void side_by_side(std::size_t count, const std::function<std::function<void()>(std::size_t)>& work);

enum class Turns { one_by_one, side_by_side };

/// Calls take(i, measure(i)) for each i below `count`: takes one at a time and in order, on any thread. What measure(i) throws is
/// thrown in its turn: take() has then been called for all before it, and for none after it.
template <class Measure, class Take>
void measure_each(std::size_t count, Turns turns, const Measure& measure, const Take& take) {
  if (turns == Turns::one_by_one) {
    for (std::size_t i = 0; i < count; ++i) {
      take(i, measure(i));
    }
    return;
  }
  side_by_side(count, [&](std::size_t i) -> std::function<void()> {
    try {
      return [&take, i, result = std::make_shared<decltype(measure(i))>(measure(i))] { take(i, std::move(*result)); };
    } catch (...) {
      return [failure = std::current_exception()] { std::rethrow_exception(failure); };
    }
  });
}

}  // namespace dmpc::apps
