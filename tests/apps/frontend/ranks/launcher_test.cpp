#include "apps/frontend/ranks/launcher.h"

#include <doctest/doctest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/support/run_dmpc.h"
#include "tests/support/text.h"

namespace dmpc::tests::launcher_test {

namespace {

using apps::Launcher;
using Variables = std::map<std::string, std::string>;

std::optional<Launcher> launcher_of(const Variables& variables) {
  return apps::launcher([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

/// "mpirun 1/3": launcher, rank and count.
std::string text_of(const std::optional<Launcher>& launcher) {
  return launcher ? launcher->name + " " + std::to_string(launcher->rank) + "/" + std::to_string(launcher->rank_count) : "none";
}

Said dmpc_with(const std::vector<std::string>& variables, const std::vector<std::string>& arguments) {
  return run_dmpc(arguments, variables);
}

}  // namespace

TEST_CASE("a process that was started alone has no launcher") {
  CHECK(text_of(launcher_of({})) == "none");
  CHECK(text_of(launcher_of({{"PATH", "/bin"}, {"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}})) == "none");  // a batch script
}

TEST_CASE("each launcher is known by what it sets") {
  CHECK(text_of(launcher_of({{"OMPI_COMM_WORLD_SIZE", "3"}, {"OMPI_COMM_WORLD_RANK", "1"}})) == "mpirun 1/3");
  CHECK(text_of(launcher_of({{"PMI_SIZE", "5"}, {"PMI_RANK", "4"}})) == "mpiexec 4/5");
  CHECK(text_of(launcher_of({{"SLURM_STEP_NUM_TASKS", "8"}, {"SLURM_PROCID", "0"}})) == "srun 0/8");
}

TEST_CASE("mpirun, which may use srun to get elsewhere, counts before it") {
  CHECK(text_of(launcher_of({{"SLURM_STEP_NUM_TASKS", "2"},
                             {"SLURM_PROCID", "1"},
                             {"OMPI_COMM_WORLD_SIZE", "6"},
                             {"OMPI_COMM_WORLD_RANK", "5"}})) == "mpirun 5/6");
}

TEST_CASE("srun may leave MPI without a word of its ranks") {
  const Variables alone = {{"SLURM_STEP_NUM_TASKS", "8"}, {"SLURM_PROCID", "0"}};
  CHECK_FALSE(launcher_of(alone)->tells_mpi);
  for (const char* const sign : {"PMIX_RANK", "PMI_RANK", "PMI_FD"}) {
    Variables reported = alone;
    reported[sign] = "0";
    CHECK(launcher_of(reported)->tells_mpi);
  }
  CHECK(launcher_of({{"OMPI_COMM_WORLD_SIZE", "3"}, {"OMPI_COMM_WORLD_RANK", "1"}})->tells_mpi);
}

TEST_CASE("what is no number, or half of it, is no sign of a launcher") {
  CHECK(text_of(launcher_of({{"PMI_SIZE", "many"}, {"PMI_RANK", "0"}})) == "none");
  CHECK(text_of(launcher_of({{"PMI_SIZE", "3x"}, {"PMI_RANK", "0"}})) == "none");
  CHECK(text_of(launcher_of({{"PMI_SIZE", ""}, {"PMI_RANK", ""}})) == "none");
  CHECK(text_of(launcher_of({{"PMI_SIZE", "3"}})) == "none");
}

TEST_CASE("a command that several processes would each do is refused by all of them, and one says why") {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"info", "tetra-1"}, {"render", "tetra-1", "-o", "/nowhere/a.png"}}) {
    const Said first = dmpc_with({"OMPI_COMM_WORLD_SIZE=3", "OMPI_COMM_WORLD_RANK=0"}, arguments),
               other = dmpc_with({"OMPI_COMM_WORLD_SIZE=3", "OMPI_COMM_WORLD_RANK=2"}, arguments);
    CHECK(first.status == 2);
    CHECK_MESSAGE(contains(first.errors, "mpirun has started 3 processes, and each of them would do all of this"), first.errors);
    CHECK(first.output == "");
    CHECK(other.status == 2);
    CHECK(other.errors == "");
    CHECK(other.output == "");
  }
}

TEST_CASE("a wrong line is said once") {
  const auto said = [](const std::string& rank) {
    return dmpc_with({"PMI_SIZE=3", "PMI_RANK=" + rank}, {"info", "--nodes=x", "tetra-1"});
  };
  CHECK(said("0").status == 2);
  CHECK(contains(said("0").errors, "--nodes"));
  CHECK(said("1").status == 2);
  CHECK(said("1").errors == "");
}

TEST_CASE("one process under a launcher, and what does nothing, are as without") {
  CHECK(dmpc_with({"OMPI_COMM_WORLD_SIZE=1", "OMPI_COMM_WORLD_RANK=0"}, {"info", "tetra-1"}).status == 0);
  CHECK(dmpc_with({"OMPI_COMM_WORLD_SIZE=3", "OMPI_COMM_WORLD_RANK=0"}, {"--version"}).status == 0);
}

}  // namespace dmpc::tests::launcher_test
