#include "apps/edge/system/file_lock.h"

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

int open_lock(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) {
    throw core::InputError(path.string() + ": cannot be made: " + std::strerror(errno));
  }
  return file;
}

/// Whether `path` still names this file, which another may have removed since it was opened.
bool is_named(int file, const std::filesystem::path& path) {
  struct stat ours {};
  struct stat there {};
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
         ours.st_ino == there.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& path) {
  for (;;) {
    const int file = open_lock(path);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file);
      return std::nullopt;
    }
    if (is_named(file, path)) {
      return FileLock(path, file);
    }
    ::close(file);
  }
}

FileLock::FileLock(const std::filesystem::path& path, int file)
    : path_(path), file_(file), removed_at_once_(std::make_unique<RemovedAtOnce>(path)) {}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), removed_at_once_(std::move(other.removed_at_once_)) {}

/// Removed before it is let go: who has opened it meanwhile sees that it is not named any more.
FileLock::~FileLock() {
  if (file_ >= 0) {
    ::unlink(path_.c_str());
    ::close(file_);
  }
}

}  // namespace dmpc::apps
