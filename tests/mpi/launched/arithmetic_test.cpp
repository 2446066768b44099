// Ranks beside a library that changes the arithmetic of every thread: the picture keeps its bits.
#ifdef DMPC_FOREIGN_ARITHMETIC

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/mpi/launched/mpirun.h"
#include "tests/support/film_in.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

namespace {

/// `given` are options of mpirun.
std::string film_of_three_ranks(const std::string& strategy, const std::vector<std::string>& given) {
  const TemporaryFolder folder;
  std::vector<std::string> command =
      mpirun(3, {"render", "rings-2-t1", "--resolution=48x48", "--nodes=4", "--quiet", "--runner=mpi", "--strategy=" + strategy,
                 "--stats=" + (folder / "s.json").string(), "-o", folder / "a.png"});
  command.insert(std::find(command.begin(), command.end(), "mpirun") + 1, given.begin(), given.end());
  const Ended ended = end_of(command);
  CHECK_MESSAGE(ended.status == 0, ended.errors);
  CHECK(ended.errors.empty());
  return film_in(folder / "s.json");
}

}  // namespace

TEST_CASE("a library that flushes to zero and rounds down in every thread of every rank changes no picture") {
  for (const char* const strategy : {"svm", "dataflow"}) {
    CAPTURE(strategy);
    CHECK(film_of_three_ranks(strategy, {"-x", "LD_PRELOAD=" DMPC_FOREIGN_ARITHMETIC}) == film_of_three_ranks(strategy, {}));
  }
}

}  // namespace dmpc::tests

#endif
