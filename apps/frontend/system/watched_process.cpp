#include "apps/frontend/system/watched_process.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "apps/frontend/system/child_process.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr useconds_t pause_microseconds = 1000;

std::size_t anonymous_bytes(pid_t id) {
  std::ostringstream text;
  text << std::ifstream("/proc/" + std::to_string(id) + "/status").rdbuf();
  return anonymous_bytes_in(text.str());
}

constexpr int looks_again = 20;

}  // namespace

std::size_t anonymous_bytes_in(std::string_view status) {
  constexpr std::string_view name = "RssAnon:";
  const std::size_t at = status.find(name);
  if (at == std::string_view::npos) {
    return 0;
  }
  status.remove_prefix(at + name.size());
  status.remove_prefix(std::min(status.find_first_not_of(" \t"), status.size()));
  std::size_t kilobytes = 0;
  std::from_chars(status.data(), status.data() + status.size(), kilobytes);
  return kilobytes * 1024;
}

WatchedProcess watch_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const Interrupt& interrupt) {
  // The program's name may mean another one to its child, as /proc/self/exe does.
  std::error_code unknown;
  const std::filesystem::path found = std::filesystem::canonical(program, unknown), path = unknown ? program : found;
  ChildProcess process({.program = path.string(), .arguments = arguments, .gets_ctrl_c = false});
  WatchedProcess watched;
  std::optional<int> status;
  while (!(status = process.status())) {
    interrupt.check();
    if (const std::size_t bytes = anonymous_bytes(process.id()); bytes > watched.peak_anonymous_bytes.value_or(0)) {
      watched.peak_anonymous_bytes = bytes;
    }
    ::usleep(pause_microseconds);
  }
  watched.status = *status;
  watched.complaint = process.errors();
  return watched;
}

std::size_t peak_anonymous_bytes(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const Interrupt& interrupt) {
  WatchedProcess watched = watch_process(program, arguments, interrupt);
  // On a busy machine a short-lived process may end between two samples.
  for (int again = 0; again < looks_again && watched.status == 0 && !watched.peak_anonymous_bytes; ++again) {
    watched = watch_process(program, arguments, interrupt);
  }
  if (watched.status != 0) {
    throw core::InputError(program.string() + " was to be watched and ended with status " + std::to_string(watched.status) +
                           (watched.complaint.empty() ? "" : ", saying: " + watched.complaint));
  }
  if (!watched.peak_anonymous_bytes) {
    throw core::InputError("the memory of " + program.string() + " could not be seen in /proc");
  }
  return *watched.peak_anonymous_bytes;
}

}  // namespace dmpc::apps
