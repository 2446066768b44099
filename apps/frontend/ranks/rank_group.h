// The processes that run one computer together; each is a rank, started by MPI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "apps/frontend/ranks/compatibility.h"
#include "apps/frontend/ranks/processors.h"
#include "apps/frontend/system/module.h"
#include "core/base/expect.h"
#include "nodes/computer_request.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::apps {

struct MpiLibrary;

/// The parameters of a program that runs over ranks.
struct RankStart {
  Compatibility own;  ///< has to be equal on all ranks
  CompanionOf module_of = CompanionOf::dmpc;
};

/// One rank of the group. All ranks make the same calls in the same order; otherwise collective calls wait for ever. Made by
/// run_as_rank(), once in a process. Thread safety: belongs to the thread that made it, the communicating thread.
class RankGroup {
 public:
  RankGroup(const RankGroup&) = delete;
  RankGroup& operator=(const RankGroup&) = delete;

  /// Rank 0 reads, builds, prints and writes.
  std::uint32_t rank() const { return rank_; }
  std::uint32_t rank_count() const { return static_cast<std::uint32_t>(names_.size()); }
  /// For messages: "rank 2 on host b".
  const std::string& name_of(std::uint32_t rank) const { return names_.at(rank); }

  /// Default number of nodes: on each rank one less than its share of the processors, as one is for the communicating thread, and
  /// at least one.
  std::uint32_t default_node_count() const;
  /// Default behaviour of this rank's communicating thread while nothing arrives, for such a computer.
  nodes::Idle default_idle(const nodes::ComputerRequest& computer) const;

  /// Waits for all ranks and makes the fabric, for packets of up to `payload_bytes_max` bytes; it lives as long as this object.
  /// Called once. Throws core::InputError, alike on all ranks, if they want frames of different sizes or differ in `more`, which
  /// must be equal.
  nodes::Fabric& connect(std::size_t payload_bytes_max, Compatibility more = {});

 private:
  friend int run_as_rank(const RankStart& start, const std::function<int(RankGroup&)>& run);
  RankGroup(const MpiLibrary& library, const Compatibility& own);

  const MpiLibrary& library_;
  std::uint32_t rank_;
  std::vector<std::string> names_;          ///< by rank
  std::vector<RankProcessors> processors_;  ///< likewise
};

/// Starts MPI, calls run(group), ends MPI, and returns the result of run(). It first checks that all ranks are compatible. Throws
/// core::UsageError if MPI knows of fewer processes than were started, core::InputError if they are not compatible (on all
/// ranks), InstallationError if the module dmpc_mpi.so is missing, and what run() throws.
///
/// An error that all ranks throw, each for itself or by agreement, is printed by rank 0: on the others stderr is suppressed. An
/// error of some ranks is printed by each of these, and end_ranks() then ends the others.
int run_as_rank(const RankStart& start, const std::function<int(RankGroup&)>& run);

/// To be called before an error about the command line: if this process was started together with others, checks that these have
/// the same words, so that rank 0 alone needs to print the error. Throws core::InputError with both lines, on all ranks, if they
/// differ. Where the processes cannot communicate, only the first prints the error.
void agree_on_words(CompanionOf whose = CompanionOf::dmpc);

/// Calls act(); calls agree_on_words() before a core::UsageError is passed on.
template <class Act>
std::invoke_result_t<const Act&> with_words_agreed(const Act& act, CompanionOf whose = CompanionOf::dmpc) {
  try {
    return act();
  } catch (const core::UsageError&) {
    agree_on_words(whose);
    throw;
  }
}

/// To be called last: if MPI could not be ended, because not all ranks have come to its end, it is aborted, which ends them all.
void end_ranks(int status);

}  // namespace dmpc::apps
