// A folder for files that nobody wants to keep.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <optional>
#include <string>

#include "apps/edge/system/folder_heir.h"
#include "apps/edge/system/interrupt.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// Made where the system keeps temporary files; gone with everything in it in the end, whatever ends the process. Throws
/// core::InputError if none can be made.
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
