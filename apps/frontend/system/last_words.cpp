#include "apps/frontend/system/last_words.h"

#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <new>
#include <string>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

namespace {

std::atomic<bool> has_run_out = false, is_loading = false;

/// "; the limit of its control group (/sys/fs/cgroup/memory.max) is 512 MiB": prepared in advance, and not written by a stream.
std::array<char, 512> memory_limit{};

/// Of the file that is mapped.
std::atomic<const std::byte*> mapped_first = nullptr, mapped_end = nullptr;
std::array<char, 512> mapped_path{};

/// Acts as without a handler, but notes the failure.
void note_end_of_memory() {
  has_run_out = true;
  throw std::bad_alloc();
}

/// Does not use a stream, whose state is unknown here.
void say(std::initializer_list<const char*> words) {
  for (const char* const word : words) {
    static_cast<void>(!::write(STDERR_FILENO, word, std::strlen(word)));
  }
}

int complain_of(const std::exception_ptr& thrown) {
  if (memory_has_run_out()) {
    return complain_of_memory();
  }
  if (is_loading) {
    say(
        {"dmpc: a library that is loaded for this job lacks threads or memory: ask for higher limits (ulimit -u, ulimit -v, "
         "pids.max "
         "of a container)\n"});
    return no_capacity_status;
  }
  try {
    if (thrown) {
      std::rethrow_exception(thrown);
    }
    say({"dmpc: this is a bug in dmpc, please report it: it was ended\n"});
  } catch (const std::bad_alloc&) {
    return complain_of_memory();
  } catch (const std::exception& error) {
    say({"dmpc: this is a bug in dmpc, please report it: ", error.what(), "\n"});
  } catch (...) {
    say({"dmpc: this is a bug in dmpc, please report it: what was thrown is no exception\n"});
  }
  return internal_status;
}

/// Otherwise the signal is a fault, or our own abort().
bool is_sent_by_another(const siginfo_t& info) { return info.si_code <= 0 && info.si_pid != ::getpid(); }

/// The C library aborts if it needs memory and may not fail, and libraries use memory that they failed to allocate. A signal that
/// has nothing to do with lack of memory ends the process as it would have otherwise; a crash long after a lack of memory, for
/// another reason, cannot be distinguished.
[[maybe_unused]] void end_crash(int signal, siginfo_t* info, void* /*context*/) {
  const bool is_for_want_of_memory = (errno == ENOMEM || memory_has_run_out()) && !is_sent_by_another(*info);
  const auto* const place = static_cast<const std::byte*>(info->si_addr);
  const bool is_cut = signal == SIGBUS && !is_sent_by_another(*info) && place >= mapped_first && place < mapped_end;
  remove_files_under_way();
  if (is_cut) {
    say({"dmpc: ", mapped_path.data(), " was cut while it was in use\n"});
    ::_exit(input_status);
  }
  if (is_for_want_of_memory) {
    ::_exit(complain_of_memory());
  }
  ::raise(signal);  // a signal that was sent does not recur by itself
}

}  // namespace

bool memory_has_run_out() { return has_run_out; }

LoadsLibrary::LoadsLibrary() { is_loading = true; }
LoadsLibrary::~LoadsLibrary() { is_loading = false; }

MappedBytes::MappedBytes(std::span<const std::byte> bytes, std::string_view path) : first_(bytes.data()) {
  mapped_path.fill('\0');
  path.copy(mapped_path.data(), mapped_path.size() - 1);
  mapped_end = bytes.data() + bytes.size();
  mapped_first = bytes.data();
}

MappedBytes::~MappedBytes() {
  if (mapped_first == first_) {
    mapped_end = nullptr;
  }
}

int complain_of_memory() {
  say(
      {"dmpc: this computer has not enough memory for that: ask for less of it (a smaller scene or picture, fewer nodes), or run "
       "it where there is more",
       memory_limit.data(), "\n"});
  return no_capacity_status;
}

void name_memory_limit(std::string_view source, std::string_view bytes) {
  std::string text = source.empty() ? "" : "; " + std::string(source) + " is " + std::string(bytes);
  memory_limit.fill('\0');
  text.copy(memory_limit.data(), memory_limit.size() - 1);
}

void end_without_abort() {
  [[maybe_unused]] struct sigaction action {};
  action.sa_sigaction = end_crash;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_SIGINFO);
#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer reports more about a crash
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS}) {
    ::sigaction(signal, &action, nullptr);
  }
#endif
  void* frame = nullptr;
  ::backtrace(&frame, 1);  // loads now the library that ends threads; the C library would abort if memory were lacking later
  std::set_new_handler(note_end_of_memory);
  std::set_terminate([] {
    remove_files_under_way();
    ::_exit(complain_of(std::current_exception()));
  });
}

}  // namespace dmpc::apps
