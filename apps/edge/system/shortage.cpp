#include "apps/edge/system/shortage.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace dmpc::apps {
namespace {

struct Shortage {
  int error;
  const char* short_name;  ///< where the dynamic loader has no memory for words
  const char* advice;
};

constexpr std::array shortages{
    Shortage{EAGAIN, "Error 11", "let dmpc start more processes and threads (ulimit -u, pids.max of a container)"},
    Shortage{ENOMEM, "Error 12", "let dmpc have more memory (ulimit -v, ulimit -d), or run it where there is more"},
    Shortage{EMFILE, "Error 24", "let dmpc open more files (ulimit -n)"},
    Shortage{ENFILE, "Error 23", "let this computer open more files (fs.file-max)"},
};

[[noreturn]] void complain(const Shortage& shortage, const std::string& what) {
  throw ComputerRoomError(what + ": " + std::strerror(shortage.error) + ": " + shortage.advice);
}

bool is_in(std::string_view words, std::string_view text) { return text.find(words) != std::string_view::npos; }

bool speaks_of(const Shortage& shortage, std::string_view complaint) {
  return is_in(std::strerror(shortage.error), complaint) || is_in(shortage.short_name, complaint) ||
         (shortage.error == ENOMEM &&
          (is_in("bad_alloc", complaint) || is_in("failed to map", complaint) || is_in("cannot map", complaint)));
}

}  // namespace

void throw_if_short(int error, const std::string& what) {
  const auto found =
      std::find_if(shortages.begin(), shortages.end(), [error](const Shortage& shortage) { return shortage.error == error; });
  if (found != shortages.end()) {
    complain(*found, what);
  }
}

void throw_if_short(std::string_view complaint, const std::string& what) {
  const auto found = std::find_if(shortages.begin(), shortages.end(),
                                  [complaint](const Shortage& shortage) { return speaks_of(shortage, complaint); });
  if (found != shortages.end()) {
    complain(*found, what);
  }
}

}  // namespace dmpc::apps
