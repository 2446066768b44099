// A claim on a file that only one process at a time has.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/frontend/system/descriptor.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// While it lives no other FileLock of any process has the same `path`. The file there, which has nothing in it, is made if need
/// be, and removed in the end, after a killed process too by the next that locks it: the kernel itself takes the lock from a
/// process that has ended. Not thread-safe.
class FileLock {
 public:
  /// Nothing, if another has it. Where the file system knows no locks everybody gets one. Throws core::InputError if the file
  /// cannot be made, or is a symbolic link, which is not followed.
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
