// Work on a thread of its own, for which this thread, to which something belongs that no other may touch, does forwarded calls.
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
class CallForwarder {
 public:
  /// What work() returns or throws. Meanwhile look_after() is called again and again. If that throws, so does every forwarded
  /// call from then on, and send_heartbeat() is called until the work is done. Then what it throws itself is thrown, unless ranks
  /// are lost or all is over, else what look_after() has thrown.
  template <class Work>
  auto while_working(const Work& work, const std::function<void()>& look_after, const std::function<void()>& send_heartbeat) {
    constexpr std::chrono::milliseconds look{10};
    is_over_ = false;
    auto result = std::async(std::launch::async, [&] {
      core::use_usual_arithmetic();
      const Over over{*this};
      return work();
    });
    while (!do_one(look)) {
      try {
        failure_ ? send_heartbeat() : look_after();
      } catch (...) {
        fail(std::current_exception());
      }
    }
    if (!failure_) {
      return result.get();
    }
    result.wait();
    if (!is_end_of_all(failure_)) {
      result.get();
    }
    std::rethrow_exception(failure_);
  }

  /// Has it done there, and returns or throws as it does.
  void send(const std::function<void()>& act);

 private:
  /// Says, in the end, that there are no more forwarded calls.
  struct Over {
    CallForwarder& call_forwarder;
    ~Over() { call_forwarder.end_work(); }
  };
  /// What the sender, which waits, wants done. What it throws there is the sender's alone.
  struct ForwardedCall {
    const std::function<void()>* act = nullptr;
    std::exception_ptr failure;
    bool is_done = false;
  };

  /// Dismissed, or LostRank.
  static bool is_end_of_all(const std::exception_ptr& failure);
  /// Waits so long for a forwarded call, and does it. Whether the work is over.
  bool do_one(std::chrono::milliseconds timeout);
  /// With the mutex locked.
  void end(ForwardedCall& forwarded_call, std::exception_ptr failure);
  void end_work();
  /// Every forwarded call that waits or comes fails as the first failure says.
  void fail(const std::exception_ptr& failure);

  std::mutex mutex_;
  std::condition_variable news_;
  ForwardedCall* pending_ = nullptr;
  std::exception_ptr failure_;
  bool is_over_ = false;
};

}  // namespace dmpc::nodes
