// A stack for signals that are caused by stack overflow.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>

namespace dmpc::nodes {

/// The calling thread's, while it exists; none under sanitizers, whose threads have one. If there is no memory for it there is
/// none: it is only for the unexpected.
class SignalStack {
 public:
  SignalStack() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    place_ = ::mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place_ != MAP_FAILED) {
      const stack_t stack{.ss_sp = place_, .ss_flags = 0, .ss_size = bytes()};
      ::sigaltstack(&stack, &before_);
    }
#endif
  }
  ~SignalStack() {
    if (place_ != MAP_FAILED) {
      ::sigaltstack(&before_, nullptr);
      ::munmap(place_, bytes());
    }
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  /// What the kernel saves there, for any number of registers, plus a handler.
  static std::size_t bytes() {
    const long least = ::sysconf(_SC_MINSIGSTKSZ);
    return (least > 0 ? static_cast<std::size_t>(least) : 0) + 32768;
  }

  void* place_ = MAP_FAILED;
  stack_t before_{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
};

}  // namespace dmpc::nodes
