// A file that is nowhere but in memory, for libraries that write to names alone.
#pragma once

#include <string>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// Gone in the end, whatever ends the process. Not thread-safe.
class MemoryFile {
 public:
  /// Throws ComputerCapacityError if there is no room for one more file.
  MemoryFile();

  int descriptor() const { return file_.number(); }
  /// A name that this process can open it by.
  std::string path() const;
  /// All that has been written to it.
  std::string bytes() const;

 private:
  Descriptor file_;
};

}  // namespace dmpc::apps
