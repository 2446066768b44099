// Preloaded into dmpc render, this sends it a SIGTERM when the last pixel is done: when it asks for its processor time for the
// second time, the first having been before the first pixel.

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>

extern "C" int getrusage(__rusage_who_t who, struct rusage* usage) noexcept {
  static int calls = 0;
  if (who == RUSAGE_SELF && ++calls == 2) {
    ::kill(::getpid(), SIGTERM);
    ::usleep(200'000);  // until the thread that waits for signals has heard it
  }
  return static_cast<int>(::syscall(SYS_getrusage, who, usage));
}
