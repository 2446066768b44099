#include "apps/ranks/mpi_library.h"

#include "apps/system/module.h"

namespace dmpc::apps {

const MpiLibrary& mpi_library() {
  static const auto* const library =
      static_cast<const MpiLibrary*>(open_module("mpi", "runs on several ranks (Debian's package is dmpc-mpi)", 0));
  return *library;
}

}  // namespace dmpc::apps
