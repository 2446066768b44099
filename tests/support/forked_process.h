// A body of code in a process of its own, in which signals find no threads of the tests.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include "core/base/expect.h"

namespace dmpc::tests {

/// Not with a body that needs more of this process than its memory.
class ForkedProcess {
 public:
  /// What `body` returns is the exit status, 255 if it throws. It has no stderr: what it opens first gets that number.
  explicit ForkedProcess(int (*body)()) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(STDERR_FILENO);
      try {
        ::_exit(body());
      } catch (...) {  // the tests that follow are not this process's
        ::_exit(255);
      }
    }
    core::expect(::waitpid(child, &status_, 0) == child, "a child can be waited for");
  }

  /// The exit status, or 1000 + signal if a signal ended it.
  int status() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : 1000 + WTERMSIG(status_); }

 private:
  int status_ = 0;
};

}  // namespace dmpc::tests
