#include "apps/edge/ranks/mpi_library.h"

namespace dmpc::apps {

const MpiLibrary& mpi_library(ModulePlace place) {
  static const auto* const library =
      static_cast<const MpiLibrary*>(open_module("mpi", "runs on several ranks (Debian's package is dmpc-mpi)", 0, place));
  return *library;
}

}  // namespace dmpc::apps
