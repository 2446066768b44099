// A file in memory, for libraries that write to named files only.
#pragma once

#include <string>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// The file is removed at the end of the process, however it ends. Not thread-safe.
class MemoryFile {
 public:
  /// Throws ComputerCapacityError if no further file can be made.
  MemoryFile();

  int descriptor() const { return file_.number(); }
  /// Returns a name by which this process can open it.
  std::string path() const;
  std::string bytes() const;

 private:
  Descriptor file_;
};

}  // namespace dmpc::apps
