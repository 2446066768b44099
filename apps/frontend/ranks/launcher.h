// Detects the launcher of this process and others of its kind: mpirun, srun.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace dmpc::apps {

/// A launcher as found in the environment, without MPI.
struct Launcher {
  std::string name;  ///< "mpirun", "mpiexec", "srun"
  std::uint32_t rank = 0, rank_count = 1;
  bool tells_mpi = true;  ///< whether MPI learns of its ranks: with srun it may not
};

/// Returns a variable's value; nullptr if it is not set.
using Variable = std::function<const char*(const char* name)>;

/// Nothing if this process was started alone.
std::optional<Launcher> launcher(const Variable& variable);
/// The launcher in this process's environment.
std::optional<Launcher> launcher();

/// For commands that do not work over ranks: throws core::UsageError if a launcher has started several processes, each of which
/// would do all the work, with `advice` on how to run them together. Only the first process prints it.
void expect_one_process(const std::string& advice);

/// To be called before an error that every process of a launcher finds by itself: only the first one prints it.
void leave_errors_to_first();

/// To be called before a process other than the first ends with an error, whereupon mpirun ends all: the first has time to print
/// it.
void leave_time_to_say_it();

/// Suppresses stderr for the rest of this process: another one prints errors.
void say_no_more();

}  // namespace dmpc::apps
