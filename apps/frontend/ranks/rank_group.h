// The processes that run one computer together, each a rank, as MPI has started them.
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

/// What a program brings along to be a rank.
struct RankStart {
  Compatibility own;  ///< what it must have in common with all others
  CompanionOf module_of = CompanionOf::dmpc;
};

/// One rank's part in it. All ranks make the same calls in the same order: what is said to wait for all would wait for ever else.
/// Made by run_as_rank(), once in a process. Thread safety: belongs to the thread that made it, the communicating thread.
class RankGroup {
 public:
  RankGroup(const RankGroup&) = delete;
  RankGroup& operator=(const RankGroup&) = delete;

  /// Rank 0 reads, builds, prints and writes.
  std::uint32_t rank() const { return rank_; }
  std::uint32_t rank_count() const { return static_cast<std::uint32_t>(names_.size()); }
  /// For messages: "rank 2 on host b".
  const std::string& name_of(std::uint32_t rank) const { return names_.at(rank); }

  /// How many nodes there are where nobody says: on each rank one less than its share of the processors that it may use, as one
  /// is the communicating thread's, and one at least.
  std::uint32_t default_node_count() const;
  /// What this rank's communicating thread does while nothing comes, of such a computer, where nobody says.
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

/// Starts MPI, calls run(group), ends MPI, and returns what run() has. Before it calls, it makes sure that all ranks are alike.
/// Throws core::UsageError if MPI knows of fewer processes than were started,
/// core::InputError if they are not alike (on all ranks), InstallationError if the module dmpc_mpi.so is not there, and what
/// run() throws.
///
/// What all ranks throw, each for itself or by agreement, rank 0 is to say: on the others nothing more is said on stderr. What
/// only some throw, each of them says, and end_ranks() then ends the others.
int run_as_rank(const RankStart& start, const std::function<int(RankGroup&)>& run);

/// Before an error of the words that a process was called with: where it was started together with others, makes sure that these
/// have the same, so that rank 0 alone need say it. Throws core::InputError with both words, on all ranks, if they have others.
/// Where the processes cannot talk to each other the first is left to say it.
void agree_on_words(CompanionOf whose = CompanionOf::dmpc);

/// What act() returns or throws; before a core::UsageError that agree_on_words().
template <class Act>
std::invoke_result_t<const Act&> with_words_agreed(const Act& act, CompanionOf whose = CompanionOf::dmpc) {
  try {
    return act();
  } catch (const core::UsageError&) {
    agree_on_words(whose);
    throw;
  }
}

/// To be called last: where MPI could not be ended, as not all ranks have come to that, it is aborted, and all of them end.
void end_ranks(int status);

}  // namespace dmpc::apps
