// The program dmpc_policy_host: feeds caches by a replacement policy from a shared library, which may crash, for dmpc, which
// starts it.

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

#include "apps/policy/library_policy.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

bool is_done = false;

void say(const char* words) { static_cast<void>(!::write(STDERR_FILENO, words, std::strlen(words))); }

/// Without memory, and perhaps on another stack.
void tell_of_end(const char* how) {
  const char* const call = policy_call_under_way();
  say(*call == '\0' ? "its library" : call);
  say(": ");
  say(how);
}

void tell_of_crash(int signal) {
  tell_of_end("it crashed (");
  say(signal == SIGSEGV  ? "SIGSEGV"
      : signal == SIGBUS ? "SIGBUS"
      : signal == SIGFPE ? "SIGFPE"
      : signal == SIGILL ? "SIGILL"
                         : "SIGABRT");
  say(")");
  ::_exit(1);
}

void tell_of_exit() {
  if (!is_done) {
    tell_of_end("it ended the process");
    ::_exit(1);
  }
}

void watch_over_crashes() {
  static std::array<char, 65536> stack;
  const stack_t other{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = tell_of_crash;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    ::sigaction(signal, &action, nullptr);
  }
  static_cast<void>(std::atexit(tell_of_exit));
}

/// Answers go where stdout went; what the library prints there goes to stderr.
void answer_to(int output, const std::string& path) {
  const PolicyRequest request = take_request(STDIN_FILENO);
  answer_by_library(path, request, [output](const std::string& line) {
    const std::string text = line + '\n';
    core::expect(::write(output, text.data(), text.size()) == static_cast<ssize_t>(text.size()), "answers are written");
  });
}

}  // namespace
}  // namespace dmpc::apps

int main(int count, char** values) {
  int status = 0;
  try {
    if (count != 2) {
      throw dmpc::core::InternalError("dmpc_policy_host is started by dmpc alone, which tells it what to do");
    }
    const int output = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    dmpc::apps::watch_over_crashes();
    dmpc::apps::answer_to(output, values[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::flush;
    status = 1;
  }
  dmpc::apps::is_done = true;
  ::_exit(status);  // whatever the library would do in the end
}
