// What has started this process together with others of its kind: mpirun, srun.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace dmpc::apps {

/// As a process learns it from its environment, without MPI.
struct Launcher {
  std::string name;  ///< "mpirun", "mpiexec", "srun"
  std::uint32_t rank = 0, rank_count = 1;
  bool tells_mpi = true;  ///< whether ranks learn of MPI: srun may not pass it on
};

/// A variable's value; nothing if it is not set.
using Variable = std::function<const char*(const char* name)>;

/// Nothing if this process was started alone.
std::optional<Launcher> launcher(const Variable& variable);
/// The launcher that this process's environment tells of.
std::optional<Launcher> launcher();

/// For what knows nothing of ranks: throws core::UsageError if a launcher has started several processes, each of which would do
/// all, with `advice` on how they would work together. The first of them says it.
void expect_one_process(const std::string& advice);

/// Before an error that all processes of a launcher come to, each by itself: the first one is to say it.
void leave_errors_to_first();

/// Before a process other than the first ends with an error, with which mpirun ends all: the first is to have said it by then.
void leave_time_to_say_it();

/// From now on this process says nothing on stderr, in its whole life: another one does.
void say_no_more();

}  // namespace dmpc::apps
