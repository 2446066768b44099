// A folder for temporary files.
#pragma once

#include <stdlib.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/system/descriptor.h"
#include "apps/frontend/system/interrupt.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// A process (/bin/sh) that waits for the end of this one, even by SIGKILL, and then removes the folder. It removes nothing if it
/// is ended first. It serves unexpected ends only, so the folder does without if it cannot be started.
class FolderHeir {
 public:
  explicit FolderHeir(const std::filesystem::path& folder);
  ~FolderHeir();
  FolderHeir(const FolderHeir&) = delete;
  FolderHeir& operator=(const FolderHeir&) = delete;

 private:
  Descriptor life_;  ///< its other end is closed with this process
  pid_t id_ = -1;
};

/// The folder is made in the system's folder for temporary files, and removed with its contents at the end, however the process
/// ends. Throws core::InputError if it cannot be made.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    const std::filesystem::path place = std::filesystem::temp_directory_path(error);
    std::string name = (place / "dmpc-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr) {
      throw core::InputError("no temporary folder can be made as " + name + ": set TMPDIR to a folder that can be written to");
    }
    path_ = name;
    removed_at_once_.emplace(path_, RemovedAtOnce::Kind::folder);
    heir_.emplace(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  std::optional<RemovedAtOnce> removed_at_once_;
  std::optional<FolderHeir> heir_;
};

}  // namespace dmpc::apps
