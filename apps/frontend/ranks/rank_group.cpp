#include "apps/frontend/ranks/rank_group.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

#include "apps/frontend/ranks/launcher.h"
#include "apps/frontend/ranks/mpi_library.h"
#include "nodes/node_id.h"
#include "nodes/ranks/frame.h"

namespace dmpc::apps {

namespace {

using namespace std::chrono_literals;

/// Who has failed waits so long for the others, which may be about to find the same.
constexpr std::chrono::milliseconds timeout_in_failure = 5s;
/// Who is done waits for rank 0, which writes: for as long as that takes.
constexpr std::chrono::milliseconds timeout_at_the_end = 24h;

/// MPI, while it is started.
const MpiLibrary* started = nullptr;

bool finish(std::chrono::milliseconds timeout) {
  const bool is_finished = started->finish(timeout);
  if (is_finished) {
    started = nullptr;
  }
  return is_finished;
}

std::string advice_on_srun(const std::string& mpi) {
  return "start it by srun --mpi=" + std::string(mpi.starts_with("MPICH") ? "pmi2" : "pmix") +
         " (srun --mpi=list lists the choices)";
}

/// A launcher of another MPI, or without one, starts processes that know nothing of each other: each knows but `rank_count`.
void expect_all_known(const MpiLibrary& library, std::uint32_t rank_count) {
  const std::optional<Launcher> launched = launcher();
  if (!launched || launched->rank_count <= rank_count) {
    return;
  }
  const std::string advice = launched->name == "srun" ? advice_on_srun(library.version())
                                                      : "start it by the " + launched->name + " of " + library.version();
  throw core::UsageError(launched->name + " has started " + std::to_string(launched->rank_count) + " processes, of which MPI (" +
                         library.version() + ") knows " + std::to_string(rank_count) + ": " + advice);
}

/// Open MPI would end each process itself, and say at length how it was not built. Others may know of ranks by libraries of
/// Slurm's.
void expect_to_be_reported(const MpiLibrary& library) {
  const std::optional<Launcher> launched = launcher();
  if (launched && !launched->tells_mpi && library.version().starts_with("Open MPI")) {
    leave_errors_to_first();
    expect_all_known(library, 1);
  }
}

/// Thrown where words are alike, to end as an error does that all come to.
struct AreCompatible {};

/// Whether this is the first of those that were started together.
bool is_first(const MpiLibrary& library) {
  const std::optional<Launcher> launched = launcher();
  return library.rank() == 0 && (!launched || launched->rank == 0);
}

}  // namespace

RankGroup::RankGroup(const MpiLibrary& library, const Compatibility& own)
    : library_(library),
      rank_(library.rank()),
      names_(library.exchange("rank " + std::to_string(rank_) + " on host " + library.host())) {
  expect_alike(library_.exchange(text_of(own)), names_);
  for (const std::string& text : library_.exchange(text_of(own_processors(library.host())))) {
    processors_.push_back(parse_processors(text));
  }
}

std::uint32_t RankGroup::default_node_count() const {
  std::uint32_t count = 0;
  for (std::uint32_t rank = 0; rank < rank_count(); ++rank) {
    count += default_nodes_on(share_of_processors(processors_, rank));
  }
  return std::min(count, nodes::node_count_max);
}

nodes::Idle RankGroup::default_idle(const nodes::ComputerRequest& computer) const {
  const std::uint32_t nodes_here = (computer.node_count + rank_count() - 1) / rank_count();
  return apps::default_idle(share_of_processors(processors_, rank_),
                            std::min(nodes_here, computer.pool_threads.value_or(nodes_here)));
}

nodes::Fabric& RankGroup::connect(std::size_t payload_bytes_max, Compatibility more) {
  const std::size_t frame_bytes = nodes::frame_bytes_for(payload_bytes_max);
  more.emplace_back("frames in bytes", std::to_string(frame_bytes));
  expect_alike(library_.exchange(text_of(more)), names_);
  return library_.make_fabric(frame_bytes, names_);
}

int run_as_rank(const RankStart& start, const std::function<int(RankGroup&)>& run) {
  const MpiLibrary& library = mpi_library(start.module_of);
  expect_to_be_reported(library);
  library.start();
  started = &library;
  const bool says_errors = is_first(library);
  try {
    expect_all_known(library, library.rank_count());
    RankGroup group(library, start.own);
    const int status = run(group);
    if (!finish(timeout_at_the_end)) {
      throw nodes::LostRank("not all ranks have finished");
    }
    if (status != 0 && !says_errors) {
      leave_time_to_say_it();
    }
    return status;
  } catch (const nodes::LostRank&) {
    throw;  // nobody need be waited for
  } catch (...) {
    if (finish(timeout_in_failure) && !says_errors) {
      say_no_more();
      leave_time_to_say_it();
    }
    throw;
  }
}

void agree_on_words(CompanionOf whose) {
  const std::optional<Launcher> launched = launcher();
  if (!launched || launched->rank_count < 2) {
    return;
  }
  if (!launched->tells_mpi) {
    return leave_errors_to_first();
  }
  try {
    run_as_rank({.own = call_compatibility(), .module_of = whose}, [](RankGroup&) -> int { throw AreCompatible{}; });
  } catch (const AreCompatible&) {
  } catch (const core::CapacityError&) {
    leave_errors_to_first();
  } catch (const core::InputError&) {
    throw;
  } catch (const std::exception&) {  // no MPI, or another one
    leave_errors_to_first();
  }
}

void end_ranks(int status) {
  if (started != nullptr) {
    started->abort(status);
  }
}

}  // namespace dmpc::apps
