#include "apps/frontend/system/available_memory.h"

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/last_words.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return a > unlimited - b ? unlimited : a + b; }

/// Reads a number that is alone in its file; returns nothing if there is none, as in "max".
std::optional<std::uint64_t> number_in(const std::string& file) {
  std::uint64_t number = 0;
  return std::ifstream(file) >> number ? std::optional(number) : std::nullopt;
}

/// The minimum of all known limits.
class Least {
 public:
  explicit Least(AvailableMemory room) : room_(std::move(room)) {}

  void add(std::uint64_t bytes, const std::string& source) {
    if (bytes < room_.bytes) {
      room_ = {bytes, source, true};
    }
  }
  const AvailableMemory& room() const { return room_; }

 private:
  AvailableMemory room_;
};

AvailableMemory computer_capacity(std::uint64_t& swap) {
  struct sysinfo info {};
  if (::sysinfo(&info) != 0) {
    return {unlimited, ""};
  }
  swap = std::uint64_t{info.totalswap} * info.mem_unit;
  return {sum(std::uint64_t{info.totalram} * info.mem_unit, swap), "this computer's memory"};
}

void add_process_limits(Least& least) {
  for (const auto& [resource, source] :
       {std::pair{RLIMIT_AS, "this shell's limit (ulimit -v)"}, std::pair{RLIMIT_DATA, "this shell's limit (ulimit -d)"}}) {
    struct rlimit limit {};
    if (::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
      least.add(limit.rlim_cur, source);
    }
  }
}

/// The file names of one version of control groups; without a name swap is not limited.
struct GroupFiles {
  const char* limit;
  const char* swap_limit;
};
constexpr GroupFiles version_1{"/memory.limit_in_bytes", nullptr}, version_2{"/memory.max", "/memory.swap.max"};

/// Adds a group ("/a/b", "/") and its parents, up to the root of their mount, which in a container may be the only one.
void add_groups(Least& least, const std::string& mount, std::string group, const GroupFiles& files, std::uint64_t swap) {
  for (bool is_root = false; !is_root;) {
    group.resize(group.find_last_not_of('/') + 1);  // nothing if there is nothing else
    is_root = group.empty();
    const std::string folder = mount + group;
    if (const auto bytes = number_in(folder + files.limit)) {
      const auto swap_bytes = files.swap_limit == nullptr ? std::nullopt : number_in(folder + files.swap_limit);
      least.add(sum(*bytes, std::min(swap, swap_bytes.value_or(swap))),
                "the limit of its control group (" + folder + files.limit + ")");
    }
    const std::size_t parent = group.rfind('/');
    group.resize(parent == std::string::npos ? 0 : parent);
  }
}

/// Paths are texts here: when memory runs out, GCC 12's std::filesystem::path frees memory twice. Each line of the file has a
/// number, names of what is controlled (none: all, by version 2), and the group, separated by colons.
void add_control_groups(Least& least, const std::string& root, std::uint64_t swap) {
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) {
      continue;
    }
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
    const std::string mount = root + "/sys/fs/cgroup";
    if (controllers == ",,") {
      add_groups(least, mount, group, version_2, swap);
      add_groups(least, mount + "/unified", group, version_2, swap);
    } else if (controllers.find(",memory,") != std::string::npos) {
      add_groups(least, mount + "/memory", group, version_1, swap);
    }
  }
}

}  // namespace

AvailableMemory available_memory(const std::string& root) {
  std::uint64_t swap = 0;
  Least least(computer_capacity(swap));
  add_process_limits(least);
  add_control_groups(least, root, swap);
  return least.room();
}

void check_available_memory(std::uint64_t bytes, const std::string& what, const AvailableMemory& room) {
  if (bytes > room.bytes) {
    throw ComputerCapacityError("this computer has no room for " + what + ": they take " + bytes_text(bytes) +
                                " of memory together, and " + room.source + " is " + bytes_text(room.bytes) +
                                "; ask for fewer nodes (--nodes) or less memory a node (--node-memory)");
  }
}

void bound_memory(const AvailableMemory& room) {
  struct rlimit limit {};
  name_memory_limit(room.is_limit ? room.source : "", bytes_text(room.bytes));
  if (::getrlimit(RLIMIT_DATA, &limit) == 0 && room.bytes < limit.rlim_cur) {
    limit.rlim_cur = room.bytes;
    ::setrlimit(RLIMIT_DATA, &limit);  // fails only if it would forbid existing memory
  }
}

}  // namespace dmpc::apps
