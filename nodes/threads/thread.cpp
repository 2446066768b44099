#include "nodes/threads/thread.h"

#include <algorithm>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "nodes/signal_stack.h"

namespace dmpc::nodes {
namespace {

using core::operator""_KiB;

// Instrumented code keeps shadow memory and red zones on the stack, so the plan's figure would measure the sanitizer.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t instrumented_stack_bytes_min = 1024_KiB;
#else
constexpr std::size_t instrumented_stack_bytes_min = 0;
#endif

}  // namespace

void Thread::start(std::size_t stack_bytes, void (*body)(void*), void* argument) {
  core::expect(!started_, "a thread is started once");
  body_ = body;
  argument_ = argument;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  const bool sized =
      pthread_attr_setstacksize(&attributes, core::round_up(std::max(stack_bytes, instrumented_stack_bytes_min), 4_KiB)) == 0;
  started_ = sized && pthread_create(&handle_, &attributes, enter, this) == 0;
  pthread_attr_destroy(&attributes);
  if (!started_) {
    throw core::CapacityError("this computer has no room for another thread");
  }
}

void Thread::join() {
  if (started_) {
    pthread_join(handle_, nullptr);
    started_ = false;
  }
}

void* Thread::enter(void* self) {
  const SignalStack signal_stack;
  const Thread& thread = *static_cast<Thread*>(self);
  thread.body_(thread.argument_);
  return nullptr;
}

}  // namespace dmpc::nodes
