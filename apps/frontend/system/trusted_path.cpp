#include "apps/frontend/system/trusted_path.h"

#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

/// Returns the owner that files of users unknown to this user namespace appear to have; nothing if it knows all users.
std::optional<uid_t> unknown_owner() {
  std::uint64_t inside = 0, outside = 0, count = 0;
  std::ifstream("/proc/self/uid_map") >> inside >> outside >> count;
  uid_t owner = 65534;
  std::ifstream("/proc/sys/kernel/overflowuid") >> owner;
  constexpr std::uint64_t all = 0xffffffff;
  return count >= all ? std::nullopt : std::optional(owner);
}

/// Returns whether a user of this computer other than this process's is in the group by the user's own entry, which the group
/// does not list. Users known only to a network cannot be listed.
bool is_group_of_others(gid_t id) {
  std::array<char, 16384> text{};
  passwd user{};
  passwd* found = nullptr;
  int error = 0;
  bool are_others = false;
  ::setpwent();
  while (!are_others && (error = ::getpwent_r(&user, text.data(), text.size(), &found)) == 0 && found != nullptr) {
    are_others = user.pw_gid == id && user.pw_uid != ::geteuid();
  }
  ::endpwent();
  return are_others || (error != 0 && error != ENOENT);  // unknown users may be in it
}

/// Returns whether single users and groups have separate rights (POSIX 1003.1e, withdrawn, as in Linux): then the mode's group
/// bits limit what any of them may do.
bool has_access_list(const fs::path& place) { return ::getxattr(place.c_str(), "system.posix_acl_access", nullptr, 0) > 0; }

/// Returns whether it has the user's name and no other members: many systems give each user a group.
bool is_own_group(gid_t id) {
  std::array<char, 16384> user_text{}, group_text{};
  passwd user{};
  group members{};
  passwd* user_found = nullptr;
  group* group_found = nullptr;
  if (::getpwuid_r(::geteuid(), &user, user_text.data(), user_text.size(), &user_found) != 0 || user_found == nullptr ||
      ::getgrgid_r(id, &members, group_text.data(), group_text.size(), &group_found) != 0 || group_found == nullptr) {
    return false;
  }
  const std::string_view name = user.pw_name;
  for (char** member = members.gr_mem; *member != nullptr; ++member) {
    if (name != *member) {
      return false;
    }
  }
  return name == members.gr_name && !is_group_of_others(id);
}

/// Whether a sticky folder, in which everybody may write but remove only their own files, is trusted.
enum class Sticky { keeps_apart, is_open };

class Trust {
 public:
  explicit Trust(Sticky sticky) : sticky_(sticky) {
    std::error_code unknown;
    program_ = fs::read_symlink("/proc/self/exe", unknown);
    for (const fs::path& place : {fs::path("/proc/self/exe"), program_.parent_path()}) {
      struct stat found {};
      if (::stat(place.c_str(), &found) == 0) {
        program_owner_ = program_owner_.value_or(found.st_uid);
        if ((found.st_mode & S_IWGRP) != 0 && (found.st_mode & S_ISVTX) == 0) {
          program_groups_.push_back(found.st_gid);
        }
      }
    }
  }

  std::optional<std::string> why_not(const fs::path& place) const {
    struct stat found {};
    if (::lstat(place.c_str(), &found) != 0) {
      return std::string("its owner is not known (") + std::strerror(errno) + ")";
    }
    return why_not(place, found);
  }
  std::optional<std::string> why_not(const fs::path& place, const struct stat& found) const {
    const bool is_folder = S_ISDIR(found.st_mode), holds_program = is_folder && is_above_program(place);
    const bool keeps_apart = is_folder && (found.st_mode & S_ISVTX) != 0 && sticky_ == Sticky::keeps_apart;
    if (!holds_program && !is_trusted(found.st_uid)) {
      return "it belongs to user " + std::to_string(found.st_uid);
    }
    if ((found.st_mode & S_IWOTH) != 0 && !keeps_apart && !holds_program) {
      return std::string("everybody may write to it");
    }
    if ((found.st_mode & S_IWGRP) == 0 || keeps_apart || holds_program) {
      return std::nullopt;
    }
    if (has_access_list(place)) {
      return std::string("an access list lets others write to it");
    }
    if (found.st_gid != 0 && !writes_program(found.st_gid) && !is_own_group(found.st_gid)) {
      return "group " + std::to_string(found.st_gid) + " may write to it";
    }
    return std::nullopt;
  }
  /// Returns nothing if no folder above `path` lets others replace it.
  std::optional<std::string> why_not_above(const fs::path& path) const {
    for (fs::path place = path.parent_path();; place = place.parent_path()) {
      if (const auto why = why_not(place)) {
        return "of " + place.string() + ", where it lies: " + *why;
      }
      if (place == place.parent_path()) {
        return std::nullopt;
      }
    }
  }

 private:
  bool is_trusted(uid_t owner) const {
    return owner == 0 || owner == ::geteuid() || owner == program_owner_ || owner == unknown_owner_;
  }
  bool writes_program(gid_t group) const {
    return std::find(program_groups_.begin(), program_groups_.end(), group) != program_groups_.end();
  }
  bool is_above_program(const fs::path& folder) const {
    const std::string above = folder.string() + (folder == folder.root_path() ? "" : "/");
    return program_.string().starts_with(above);
  }

  Sticky sticky_;
  fs::path program_;
  std::optional<uid_t> program_owner_, unknown_owner_ = unknown_owner();
  std::vector<gid_t> program_groups_;  ///< groups that may replace the program
};

}  // namespace

std::optional<std::string> why_untrusted(const fs::path& path) {
  const Trust trust(Sticky::keeps_apart);
  const auto why = trust.why_not(path);
  return why ? why : trust.why_not_above(path);
}

std::optional<std::string> why_untrusted(const Descriptor& file) {
  struct stat found {};
  if (::fstat(file.number(), &found) != 0) {
    return std::string("its owner is not known (") + std::strerror(errno) + ")";
  }
  return Trust(Sticky::is_open).why_not("/proc/self/fd/" + std::to_string(file.number()), found);
}

Descriptor open_trusted(const std::string& path) {
  constexpr const char* expected = "; expected the full path of a file that you alone, or root, can write";
  if (!fs::path(path).is_absolute()) {
    throw core::InputError(path + ": it does not begin with /" + expected);
  }
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));  // does not block on a pipe
  struct stat found {};
  if (!file.is_open() || ::fstat(file.number(), &found) != 0) {
    throw core::InputError(path + " cannot be opened: " + std::strerror(errno));
  }
  if (!S_ISREG(found.st_mode)) {
    throw core::InputError(path + ": it is no ordinary file" + expected);
  }
  std::error_code unknown;
  const fs::path lies_at = fs::read_symlink("/proc/self/fd/" + std::to_string(file.number()), unknown);
  if (lies_at != path) {
    throw core::InputError(path + ": it is reached by links or dots; name " +
                           (lies_at.empty() ? "the file that it is" : lies_at.string()));
  }
  const Trust trust(Sticky::is_open);
  auto why = trust.why_not(lies_at, found);
  why = why ? why : trust.why_not_above(lies_at);
  if (why) {
    throw core::InputError(path + ": others can change it, since " + *why + expected);
  }
  return file;
}

}  // namespace dmpc::apps
