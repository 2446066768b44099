// A lock file that one process at a time holds.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/frontend/system/descriptor.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// During its lifetime, no other FileLock of any process has the same `path`. The file, which is empty, is created if needed and
/// removed at the end. The kernel releases a killed process's lock, and the next process that locks the file removes it. Not
/// thread-safe.
class FileLock {
 public:
  /// Returns nothing if another process has the lock. On file systems without locks it always succeeds. Throws core::InputError
  /// if the file cannot be made, or is a symbolic link, which is not followed.
  static std::optional<FileLock> try_lock(const std::filesystem::path& path);
  FileLock(FileLock&& other) = default;
  ~FileLock();

 private:
  FileLock(const std::filesystem::path& path, Descriptor file);

  std::filesystem::path path_;
  Descriptor file_;
  std::unique_ptr<RemovedAtOnce> removed_at_once_;
};

}  // namespace dmpc::apps
