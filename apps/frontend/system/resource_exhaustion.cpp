#include "apps/frontend/system/resource_exhaustion.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace dmpc::apps {
namespace {

struct ResourceExhaustion {
  int error;
  const char* short_name;  ///< used when the dynamic loader has no memory for words
  const char* advice;
};

constexpr std::array shortages{
    ResourceExhaustion{EAGAIN, "Error 11", "let dmpc start more processes and threads (ulimit -u, pids.max of a container)"},
    ResourceExhaustion{ENOMEM, "Error 12", "let dmpc have more memory (ulimit -v, ulimit -d), or run it where there is more"},
    ResourceExhaustion{EMFILE, "Error 24", "let dmpc open more files (ulimit -n)"},
    ResourceExhaustion{ENFILE, "Error 23", "let this computer open more files (fs.file-max)"},
};

[[noreturn]] void complain(const ResourceExhaustion& resource_exhaustion, const std::string& what) {
  throw ComputerCapacityError(what + ": " + std::strerror(resource_exhaustion.error) + ": " + resource_exhaustion.advice);
}

bool is_in(std::string_view words, std::string_view text) { return text.find(words) != std::string_view::npos; }

bool speaks_of(const ResourceExhaustion& resource_exhaustion, std::string_view complaint) {
  return is_in(std::strerror(resource_exhaustion.error), complaint) || is_in(resource_exhaustion.short_name, complaint) ||
         (resource_exhaustion.error == ENOMEM &&
          (is_in("bad_alloc", complaint) || is_in("failed to map", complaint) || is_in("cannot map", complaint)));
}

}  // namespace

void throw_if_short(int error, const std::string& what) {
  const auto found = std::find_if(shortages.begin(), shortages.end(), [error](const ResourceExhaustion& resource_exhaustion) {
    return resource_exhaustion.error == error;
  });
  if (found != shortages.end()) {
    complain(*found, what);
  }
}

void throw_if_short(std::string_view complaint, const std::string& what) {
  const auto found = std::find_if(shortages.begin(), shortages.end(), [complaint](const ResourceExhaustion& resource_exhaustion) {
    return speaks_of(resource_exhaustion, complaint);
  });
  if (found != shortages.end()) {
    complain(*found, what);
  }
}

}  // namespace dmpc::apps
