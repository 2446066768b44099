// Runs independent pieces of work on the real computer's cores, several at a time.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <utility>

namespace dmpc::apps {

/// Calls work(i) for each i below `count`, as many at a time as there are cores, started in the order of i. The functions that
/// work(i) returns are called afterwards: one at a time, in the order of i. After an exception no other work starts; the first
/// exception of either is rethrown when the started ones have ended. Not for work that starts its own threads.
void side_by_side(std::size_t count, const std::function<std::function<void()>(std::size_t)>& work);

/// Calls take(i, measure(i)) for each i below `count`: one take() at a time and in order, on any thread. An exception of
/// measure(i) is thrown in its turn: take() has then been called for all before it, and for none after it.
template <class Measure, class Take>
void measure_each(std::size_t count, const Measure& measure, const Take& take) {
  side_by_side(count, [&](std::size_t i) -> std::function<void()> {
    try {
      return [&take, i, result = std::make_shared<decltype(measure(i))>(measure(i))] { take(i, std::move(*result)); };
    } catch (...) {
      return [failure = std::current_exception()] { std::rethrow_exception(failure); };
    }
  });
}

}  // namespace dmpc::apps
