#include "apps/memory_room.h"

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "apps/figures.h"
#include "core/expect.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return a > unlimited - b ? unlimited : a + b; }

/// A number alone in its file; nothing without one, as where it says "max".
std::optional<std::uint64_t> number_in(const fs::path& file) {
  std::uint64_t number = 0;
  return std::ifstream(file) >> number ? std::optional(number) : std::nullopt;
}

/// The least of all that say something.
class Least {
 public:
  explicit Least(MemoryRoom room) : room_(std::move(room)) {}

  void add(std::uint64_t bytes, const std::string& source) {
    if (bytes < room_.bytes) {
      room_ = {bytes, source};
    }
  }
  const MemoryRoom& room() const { return room_; }

 private:
  MemoryRoom room_;
};

MemoryRoom computer_room(std::uint64_t& swap) {
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

/// A group and its parents, up to the root of where they are mounted; in a container that may be all there is of the path.
void add_groups(Least& least, const fs::path& mount, fs::path group, const char* limit, const char* swap_limit,
                std::uint64_t swap) {
  for (group = group.relative_path();; group = group.parent_path()) {
    if (const auto bytes = number_in(mount / group / limit)) {
      const std::uint64_t swap_bytes = std::min(swap, number_in(mount / group / swap_limit).value_or(swap));
      least.add(sum(*bytes, swap_bytes), "the limit of its control group (" + (mount / group / limit).string() + ")");
    }
    if (group.empty()) {
      return;
    }
  }
}

/// Each line of the file: a number, names of what is controlled (none: all, by version 2), and the group, with colons between.
void add_control_groups(Least& least, const fs::path& root, std::uint64_t swap) {
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) {
      continue;
    }
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
    const fs::path mount = root / "sys/fs/cgroup";
    if (controllers == ",,") {
      add_groups(least, mount, group, "memory.max", "memory.swap.max", swap);
      add_groups(least, mount / "unified", group, "memory.max", "memory.swap.max", swap);
    } else if (controllers.find(",memory,") != std::string::npos) {
      add_groups(least, mount / "memory", group, "memory.limit_in_bytes", "", swap);
    }
  }
}

}  // namespace

MemoryRoom memory_room(const fs::path& root) {
  std::uint64_t swap = 0;
  Least least(computer_room(swap));
  add_process_limits(least);
  add_control_groups(least, root, swap);
  return least.room();
}

void check_memory_room(std::uint64_t bytes, const std::string& what, const MemoryRoom& room) {
  if (bytes > room.bytes) {
    throw core::RoomError("there is no room for " + what + ": they take " + bytes_text(bytes) + " of memory together, and " +
                          room.source + " is " + bytes_text(room.bytes) +
                          "; ask for fewer nodes (--nodes) or less memory a node (--node-memory)");
  }
}

void bound_memory(const MemoryRoom& room) {
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_DATA, &limit) == 0 && room.bytes < limit.rlim_cur) {
    limit.rlim_cur = room.bytes;
    ::setrlimit(RLIMIT_DATA, &limit);  // fails only where it would forbid what is there already
  }
}

}  // namespace dmpc::apps
