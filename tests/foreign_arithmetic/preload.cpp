// Preloaded into a program, this is a library that was built for speed: as it is loaded, in each thread that is started and
// behind each library that is opened, it makes what is tiny zero, results and operands (flush to zero, denormals are zeros), and
// rounds down.

#include <dlfcn.h>
#include <pthread.h>

#include <cfenv>
#include <memory>

namespace {

void make_arithmetic_foreign() {
  constexpr unsigned tiny_is_zero = 0x8040;
  std::fenv_t mode;
  std::fegetenv(&mode);
  mode.__mxcsr |= tiny_is_zero;
  std::fesetenv(&mode);
  std::fesetround(FE_DOWNWARD);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

using Body = void* (*)(void*);

struct Thread {
  Body body;
  void* argument;
};

void* run_thread(void* given) {
  const std::unique_ptr<Thread> thread(static_cast<Thread*>(given));
  make_arithmetic_foreign();
  return thread->body(thread->argument);
}

[[gnu::constructor]] void be_loaded() { make_arithmetic_foreign(); }

}  // namespace

extern "C" int pthread_create(pthread_t* handle, const pthread_attr_t* attributes, Body body, void* argument) noexcept {
  static const auto create = next<int (*)(pthread_t*, const pthread_attr_t*, Body, void*)>("pthread_create");
  auto thread = std::make_unique<Thread>(Thread{body, argument});
  const int failure = create(handle, attributes, run_thread, thread.get());
  if (failure == 0) {
    static_cast<void>(thread.release());
  }
  return failure;
}

extern "C" void* dlopen(const char* file, int mode) noexcept {
  static const auto open = next<void* (*)(const char*, int)>("dlopen");
  void* const opened = open(file, mode);
  make_arithmetic_foreign();
  return opened;
}
