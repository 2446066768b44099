// What the module dmpc_mpi.so does: all that dmpc asks of MPI.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/system/module.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::apps {

/// The module's interface. But for version() all of it belongs to the thread that called start(), and the fabric to one at a
/// time. Where MPI reports an error, nodes::LostRank is thrown.
struct MpiLibrary {
  /// Which MPI it is: "Open MPI v4.1.4".
  std::string (*version)();
  /// To be called first, once in a process.
  void (*start)();
  std::uint32_t (*rank)();
  std::uint32_t (*rank_count)();
  /// The name of this computer.
  std::string (*host)();
  /// What each rank says, by rank. Waits until all have said it.
  std::vector<std::string> (*exchange)(const std::string& own);
  /// Makes the fabric. Frames have `frame_bytes` bytes on all ranks, which messages call `names`. Called once; the fabric lives
  /// until finish().
  nodes::Fabric& (*make_fabric)(std::size_t frame_bytes, const std::vector<std::string>& names);
  /// Waits so long until all ranks have called it, and ends MPI. Frames that come meanwhile are dropped. False, and MPI goes on,
  /// if not all have.
  bool (*finish)(std::chrono::milliseconds timeout);
  /// Ends all ranks, this one included, with the status.
  void (*abort)(int status);
};

/// Opened at the first call, whose place counts, as open_module() says.
const MpiLibrary& mpi_library(CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
