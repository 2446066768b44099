#include "apps/frontend/system/surroundings.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "core/base/usual_arithmetic.h"

namespace dmpc::apps {

void settle_in() {
  core::use_usual_arithmetic();
  ::unsetenv("OIIO_LIBRARY_PATH");
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);  // if it is ignored, nobody can wait for a child
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) {
      static_cast<void>(::open(stream == STDIN_FILENO ? "/dev/null" : "/dev/full", O_RDWR));
    }
  }
}

bool is_pipe_broken() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

void end_by_broken_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  ::raise(SIGPIPE);
  ::_exit(128 + SIGPIPE);
}

}  // namespace dmpc::apps
