#include "apps/computer/program_call.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/system/interrupt.h"
#include "nodes/call_board.h"
#include "nodes/signal_stack.h"

namespace dmpc::apps {
namespace {

/// Seconds after which a running call is reported.
constexpr std::uint32_t timeout_seconds = 10;
/// A fault at an address this far below the start of a call is a stack overflow.
constexpr std::size_t stack_bytes_max = std::size_t{64} << 20U, stack_bytes_min = std::size_t{4} << 10U;

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

struct Call {
  const char* what = nullptr;  ///< nullptr: no call is in progress
  std::uint32_t node = 0;
  const std::byte* stack = nullptr;  ///< where the call began
};

thread_local Call call;

nodes::CallBoard board(timeout_seconds);

/// The prefix of messages before the program's name is known or from signal handlers, for which it must be static.
std::array<char, 256> name_bytes{};

/// Uses no stream, whose state is unknown in a signal handler.
void say(std::initializer_list<const char*> words) {
  for (const char* const word : words) {
    static_cast<void>(!::write(STDERR_FILENO, word, std::strlen(word)));
  }
}

struct Digits {
  std::array<char, 24> text{};

  explicit Digits(std::uint64_t number) { *std::to_chars(text.data(), text.data() + text.size() - 1, number).ptr = '\0'; }
};

bool is_of_stack(int signal, const siginfo_t& info) {
  const auto* const place = static_cast<const std::byte*>(info.si_addr);
  const auto depth = call.stack - place;
  return signal == SIGSEGV && info.si_code > 0 && depth > static_cast<std::ptrdiff_t>(stack_bytes_min) &&
         depth < static_cast<std::ptrdiff_t>(stack_bytes_max);
}

/// The signal then ends the process as usual: SA_RESETHAND.
void end_crash(int signal, siginfo_t* info, void* /*context*/) {
  remove_files_under_way();
  if (call.what != nullptr) {
    const Digits node(call.node), number(static_cast<std::uint64_t>(signal));
    say({name_bytes.data(), ": the program crashed in ", call.what, " of node ", node.text.data(), ", by signal ",
         number.text.data()});
    if (is_of_stack(signal, *info)) {
      const Digits depth(static_cast<std::uint64_t>(call.stack - static_cast<const std::byte*>(info->si_addr)) / 1024);
      say({": its stack is full, ", depth.text.data(),
           " KiB below the call: let it go less deep, and keep what is large in the node's memory"});
    }
    say({"\n"});
  }
  ::raise(signal);
}

void end_exit() {
  if (call.what != nullptr) {
    const Digits node(call.node);
    remove_files_under_way();
    say({name_bytes.data(), ": the program has ended the process in ", call.what, " of node ", node.text.data(),
         ": a program ends when all nodes have finished\n"});
    ::_exit(internal_status);
  }
}

}  // namespace

CallUnderWay::CallUnderWay(std::uint32_t node, const char* what) : node_(node) {
  call = {what, node, reinterpret_cast<const std::byte*>(this)};
  board.begin(node, what);
}

CallUnderWay::~CallUnderWay() {
  board.end(node_);
  call.what = nullptr;
}

std::string place_of_call(std::uint32_t node, const char* what) {
  return std::string(", in ") + what + " of node " + std::to_string(node);
}

struct ProgramEnds::Actions {
  std::array<struct sigaction, crashes.size()> action;
  nodes::SignalStack stack;
};

ProgramEnds::ProgramEnds(const std::string& name) : before_(std::make_unique<Actions>()) {
  name_bytes.fill('\0');
  name.copy(name_bytes.data(), name_bytes.size() - 1);
  [[maybe_unused]] struct sigaction action {};
  action.sa_sigaction = end_crash;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_SIGINFO | SA_ONSTACK;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers report more about a crash
  for (std::size_t i = 0; i < crashes.size(); ++i) {
    ::sigaction(crashes[i], &action, &before_->action[i]);
  }
#endif
  [[maybe_unused]] static const bool is_first = std::atexit(end_exit) == 0 && ::at_quick_exit(end_exit) == 0;
}

ProgramEnds::~ProgramEnds() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (std::size_t i = 0; i < crashes.size(); ++i) {
    ::sigaction(crashes[i], &before_->action[i], nullptr);
  }
#endif
}

std::function<void()> ProgramEnds::look() const {
  return [] {
    for (const nodes::CallBoard::Long& found : board.look()) {
      const Digits node(found.node), seconds(timeout_seconds);
      say({name_bytes.data(), ": ", found.what, " of node ", node.text.data(), " has not returned for ", seconds.text.data(),
           " s: a call is one bounded piece of work, and all wait for it (a second Ctrl-C ends them)\n"});
    }
  };
}

}  // namespace dmpc::apps
