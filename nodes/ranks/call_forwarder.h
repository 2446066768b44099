// Runs work on a separate thread, which forwards calls to this thread, for objects that no other thread may use.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <future>
#include <mutex>

#include "core/base/usual_arithmetic.h"

namespace dmpc::nodes {

/// Thread safety: while_working() from the thread to which it belongs, send() from that of the work.
class CallForwarder {
 public:
  /// Returns or throws what work() does. Meanwhile look_after() is called repeatedly. If that throws, so does every forwarded
  /// call from then on, and send_heartbeat() is called until the work is done. Then work()'s exception is thrown, unless ranks
  /// are lost or dismissed, otherwise look_after()'s.
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

  /// Calls `act` on the other thread, and returns or throws as it does.
  void send(const std::function<void()>& act);

 private:
  /// Reports, at the end, that there are no more forwarded calls.
  struct Over {
    CallForwarder& call_forwarder;
    ~Over() { call_forwarder.end_work(); }
  };
  /// A call that the waiting sender has forwarded. Its exceptions go only to the sender.
  struct ForwardedCall {
    const std::function<void()>* act = nullptr;
    std::exception_ptr failure;
    bool is_done = false;
  };

  /// Dismissed, or LostRank.
  static bool is_end_of_all(const std::exception_ptr& failure);
  /// Waits up to `timeout` for a forwarded call, and does it. Returns whether the work is done.
  bool do_one(std::chrono::milliseconds timeout);
  /// With the mutex locked.
  void end(ForwardedCall& forwarded_call, std::exception_ptr failure);
  void end_work();
  /// Every forwarded call, waiting or new, fails with the first failure.
  void fail(const std::exception_ptr& failure);

  std::mutex mutex_;
  std::condition_variable news_;
  ForwardedCall* pending_ = nullptr;
  std::exception_ptr failure_;
  bool is_over_ = false;
};

}  // namespace dmpc::nodes
