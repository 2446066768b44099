#include "apps/frontend/system/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

Descriptor open_lock(const std::filesystem::path& path) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!file.is_open()) {
    throw core::InputError(path.string() + ": cannot be made: " + std::strerror(errno));
  }
  return file;
}

/// Returns whether `path` still names this file, which another process may have removed since it was opened.
bool is_named(int file, const std::filesystem::path& path) {
  struct stat ours {};
  struct stat there {};
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
         ours.st_ino == there.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& path) {
  for (;;) {
    Descriptor file = open_lock(path);
    if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      return std::nullopt;
    }
    if (is_named(file.number(), path)) {
      return FileLock(path, std::move(file));
    }
  }
}

FileLock::FileLock(const std::filesystem::path& path, Descriptor file)
    : path_(path), file_(std::move(file)), removed_at_once_(std::make_unique<RemovedAtOnce>(path)) {}

/// The file is removed before the lock is released: a process that has opened it meanwhile sees that it is no longer named.
FileLock::~FileLock() {
  if (file_.is_open()) {
    ::unlink(path_.c_str());
  }
}

}  // namespace dmpc::apps
