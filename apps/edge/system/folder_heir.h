// Who removes a scratch folder where nobody else is left to.
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "apps/edge/system/descriptor.h"

namespace dmpc::apps {

/// A process (/bin/sh) that waits for the end of this one, by whatever, a signal that cannot be caught included, and removes the
/// folder then. An heir who is no more in the end removes nothing. Where none can be started there is none: it is for what
/// nobody expects.
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

}  // namespace dmpc::apps
