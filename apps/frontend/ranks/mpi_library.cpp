#include "apps/frontend/ranks/mpi_library.h"

namespace dmpc::apps {

const MpiLibrary& mpi_library(CompanionOf whose) {
  static const auto* const library =
      static_cast<const MpiLibrary*>(open_module("mpi", "runs on several ranks (Debian's package is dmpc-mpi)", whose));
  return *library;
}

}  // namespace dmpc::apps
