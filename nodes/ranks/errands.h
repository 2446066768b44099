// Work on a thread of its own, for which this thread, to which something belongs that no other may touch, does errands.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <type_traits>

#include "core/base/usual_arithmetic.h"

namespace dmpc::nodes {

/// Thread safety: while_working() from the thread to which it belongs, send() from that of the work.
class Errands {
 public:
  /// What work() returns or throws. Meanwhile look_after() is called again and again; what that throws is thrown when the work is
  /// done, and by every errand before.
  template <class Work>
  auto while_working(const Work& work, const std::function<void()>& look_after) {
    constexpr std::chrono::milliseconds look{10};
    is_over_ = false;
    auto result = std::async(std::launch::async, [&] {
      core::use_usual_arithmetic();
      const Over over{*this};
      return work();
    });
    while (!do_one(look)) {
      try {
        look_after();
      } catch (...) {
        fail(std::current_exception());
        result.wait();
        throw;
      }
    }
    return result.get();
  }

  /// Has it done there, and returns or throws as it does.
  void send(const std::function<void()>& errand);

 private:
  /// Says, in the end, that there are no more errands.
  struct Over {
    Errands& errands;
    ~Over() { errands.end(); }
  };

  /// Waits so long for an errand, and does it. Whether the work is over.
  bool do_one(std::chrono::milliseconds patience);
  void end();
  /// Every errand that waits or comes fails so.
  void fail(const std::exception_ptr& failure);

  std::mutex mutex_;
  std::condition_variable news_;
  std::packaged_task<void()> pending_;
  std::exception_ptr failure_;
  bool is_over_ = false;
};

}  // namespace dmpc::nodes
