// A thread of the real computer with a stack of a given size.
#pragma once

#include <pthread.h>

#include <cstddef>

namespace dmpc::nodes {

/// The minimum thread stack that a plan may reserve (Category::reserve), in bytes. Sanitizers get a larger one, outside the plan.
inline constexpr std::size_t thread_stack_bytes_min = std::size_t{64} << 10U;

/// Not started, running, or joined. Not thread-safe; belongs to the thread that starts it.
class Thread {
 public:
  Thread() = default;
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;
  /// Joins if started.
  ~Thread() { join(); }

  /// Runs body(argument) on a thread with at least `stack_bytes` of stack (more under sanitizers). `body` must not throw. Throws
  /// core::CapacityError if the real computer cannot create another thread.
  void start(std::size_t stack_bytes, void (*body)(void*), void* argument);
  /// Waits until the body has returned.
  void join();

 private:
  static void* enter(void* self);

  pthread_t handle_{};
  void (*body_)(void*) = nullptr;
  void* argument_ = nullptr;
  bool started_ = false;
};

}  // namespace dmpc::nodes
