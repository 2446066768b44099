#include "apps/frontend/ranks/launcher.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>

#include "apps/frontend/line/parsed_number.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// How a launcher's children know it.
struct Sign {
  const char *launcher, *rank_count, *rank;
};
/// Open MPI's, MPICH's and its kin's, Slurm's: mpirun may use srun to get to other computers, so it comes first. SLURM_NTASKS
/// would not do, as a batch script has it, which is one process.
constexpr std::array<Sign, 3> signs = {{{"mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                        {"mpiexec", "PMI_SIZE", "PMI_RANK"},
                                        {"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}}};

/// Interfaces by which srun gives MPI its ranks: PMIx, PMI, or a compatible one.
constexpr std::array<const char*, 3> signs_of_pmi = {"PMIX_RANK", "PMI_RANK", "PMI_FD"};

constexpr useconds_t time_to_say_it_us = 500'000;

std::optional<std::uint32_t> number(const char* text) { return number_in<std::uint32_t>(text == nullptr ? "" : text); }

bool has_pmi(const Variable& variable) {
  return std::any_of(signs_of_pmi.begin(), signs_of_pmi.end(), [&](const char* sign) { return variable(sign) != nullptr; });
}

}  // namespace

std::optional<Launcher> launcher(const Variable& variable) {
  for (const Sign& sign : signs) {
    const auto rank_count = number(variable(sign.rank_count)), rank = number(variable(sign.rank));
    if (rank_count && rank) {
      return Launcher{sign.launcher, *rank, *rank_count, &sign != &signs.back() || has_pmi(variable)};
    }
  }
  return std::nullopt;
}

std::optional<Launcher> launcher() { return launcher(std::getenv); }

void expect_one_process(const std::string& advice) {
  const std::optional<Launcher> started_by = launcher();
  if (!started_by || started_by->rank_count < 2) {
    return;
  }
  leave_errors_to_first();
  throw core::UsageError(started_by->name + " has started " + std::to_string(started_by->rank_count) +
                         " processes, and each of them would do all of this: call it without " + started_by->name +
                         ", or let them " + advice);
}

void leave_errors_to_first() {
  const std::optional<Launcher> started_by = launcher();
  if (started_by && started_by->rank != 0) {
    say_no_more();
    leave_time_to_say_it();
  }
}

void leave_time_to_say_it() { ::usleep(time_to_say_it_us); }

void say_no_more() { std::cerr.setstate(std::ios_base::badbit); }

}  // namespace dmpc::apps
