// A stack of its own to run a function on, switched by hand: the threads of an exploration, all on one thread of the real
// computer.
#pragma once

#include <ucontext.h>

#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace dmpc::tests {

/// Runs body(argument), which must never return, whenever its owner enters it, until it leaves again. Not thread-safe. The
/// sanitizers are told of every switch.
class Fiber {
 public:
  Fiber(void (*body)(void*), void* argument) : body_(body), argument_(argument) {
    getcontext(&inside_);
    inside_.uc_stack.ss_sp = stack_.data();
    inside_.uc_stack.ss_size = stack_.size();
    const auto self = reinterpret_cast<std::uintptr_t>(this);
    makecontext(&inside_, reinterpret_cast<void (*)()>(&Fiber::start), 2, static_cast<unsigned>(self >> 32U),
                static_cast<unsigned>(self));
#if defined(__SANITIZE_THREAD__)
    tsan_inside_ = __tsan_create_fiber(0);
#endif
  }
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;
  ~Fiber() {
#if defined(__SANITIZE_THREAD__)
    __tsan_destroy_fiber(tsan_inside_);
#endif
  }

  /// From the owner's stack: goes on inside, until leave().
  void enter() {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_start_switch_fiber(&fake_outside_, stack_.data(), stack_.size());
#endif
#if defined(__SANITIZE_THREAD__)
    tsan_outside_ = __tsan_get_current_fiber();
    __tsan_switch_to_fiber(tsan_inside_, 0);
#endif
    swapcontext(&outside_, &inside_);
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_finish_switch_fiber(fake_outside_, nullptr, nullptr);
#endif
  }

  /// From inside: back to the owner, until the next enter().
  void leave() {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_start_switch_fiber(&fake_inside_, outside_bottom_, outside_bytes_);
#endif
#if defined(__SANITIZE_THREAD__)
    __tsan_switch_to_fiber(tsan_outside_, 0);
#endif
    swapcontext(&inside_, &outside_);
    entered();
  }

 private:
  static void start(unsigned high, unsigned low) {
    auto* const self = reinterpret_cast<Fiber*>((std::uintptr_t{high} << 32U) | low);
    self->entered();
    self->body_(self->argument_);
  }

  void entered() {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_finish_switch_fiber(fake_inside_, &outside_bottom_, &outside_bytes_);
#endif
  }

  void (*body_)(void*);
  void* argument_;
  ucontext_t inside_{};
  ucontext_t outside_{};
#if defined(__SANITIZE_ADDRESS__)
  void* fake_outside_ = nullptr;
  void* fake_inside_ = nullptr;
  const void* outside_bottom_ = nullptr;
  std::size_t outside_bytes_ = 0;
#endif
#if defined(__SANITIZE_THREAD__)
  void* tsan_inside_ = nullptr;
  void* tsan_outside_ = nullptr;
#endif
  alignas(16) std::array<std::byte, std::size_t{256} << 10U> stack_{};
};

}  // namespace dmpc::tests
