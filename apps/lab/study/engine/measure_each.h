// The runs of a study, one after the other or side by side: their results come in order, and so does what ends them.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <utility>

#include "apps/lab/crowd/side_by_side.h"

namespace dmpc::apps {

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
