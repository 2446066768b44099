// The interface of the module dmpc_mpi.so: everything that dmpc needs of MPI.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/system/module.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::apps {

/// Except for version(), all functions belong to the thread that called start(), and the fabric to one thread at a time. Where
/// MPI reports an error, nodes::LostRank is thrown.
struct MpiLibrary {
  /// Name and version of MPI: "Open MPI v4.1.4".
  std::string (*version)();
  /// To be called first, once in a process.
  void (*start)();
  std::uint32_t (*rank)();
  std::uint32_t (*rank_count)();
  /// The name of this computer.
  std::string (*host)();
  /// Exchanges a text of each rank, by rank. Waits for all ranks.
  std::vector<std::string> (*exchange)(const std::string& own);
  /// Makes the fabric. Frames have `frame_bytes` bytes on all ranks, which messages call `names`. Called once; the fabric lives
  /// until finish().
  nodes::Fabric& (*make_fabric)(std::size_t frame_bytes, const std::vector<std::string>& names);
  /// Waits up to `timeout` until all ranks have called it, and ends MPI. Frames that arrive meanwhile are dropped. Returns false,
  /// and leaves MPI running, if not all ranks have called it.
  bool (*finish)(std::chrono::milliseconds timeout);
  /// Ends all ranks, this one included, with the status.
  void (*abort)(int status);
};

/// Opens the module at the first call, as open_module() does; later values of `whose` are ignored.
const MpiLibrary& mpi_library(CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
