// Ranks beside a library that changes the arithmetic of every thread: the picture keeps its bits.
#ifdef DMPC_FOREIGN_ARITHMETIC

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/mpi/launched/mpirun.h"
#include "tests/support/film_in.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::arithmetic_test {

namespace {

/// The film that a command makes of these spirals, whose generator rounds.
class ThreeRanks {
 public:
  explicit ThreeRanks(const std::string& strategy)
      : render_({"render", "shells-2", "--resolution=48x48", "--nodes=4", "--quiet", "--runner=mpi", "--strategy=" + strategy,
                 "--stats=" + (folder_ / "s.json").string(), "-o", folder_ / "a.png"}) {}

  std::string film() const { return film_of(mpirun(3, render_)); }
  /// With `given` as options of mpirun for all ranks.
  std::string film_with(const std::vector<std::string>& given) const {
    std::vector<std::string> command = mpirun(3, render_);
    command.insert(std::find(command.begin(), command.end(), "mpirun") + 1, given.begin(), given.end());
    return film_of(command);
  }
  /// With `given` for rank 2 alone.
  std::string film_with_on_last(const std::vector<std::string>& given) const {
    std::vector<std::string> command = mpirun(2, render_);
    command.insert(command.end(), {":", "-n", "1"});
    command.insert(command.end(), given.begin(), given.end());
    command.emplace_back(DMPC_PROGRAM);
    command.insert(command.end(), render_.begin(), render_.end());
    return film_of(command);
  }

 private:
  std::string film_of(const std::vector<std::string>& command) const {
    const Said ended = run(command);
    REQUIRE_MESSAGE(ended.status == 0, ended.errors);
    CHECK(ended.errors.empty());
    return film_in(folder_ / "s.json");
  }

  TemporaryFolder folder_;
  std::vector<std::string> render_;
};

const std::vector<std::string> beside_it = {"-x", "LD_PRELOAD=" DMPC_FOREIGN_ARITHMETIC};

}  // namespace

TEST_CASE("a library that flushes to zero and rounds down in every thread of every rank changes no picture" *
          doctest::test_suite("slow")) {
  for (const std::string strategy : {"svm", "dataflow"}) {
    CAPTURE(strategy);
    const ThreeRanks ranks(strategy);
    CHECK(ranks.film_with(beside_it) == ranks.film());
  }
}

TEST_CASE("a rank beside a library that flushes to zero and rounds down goes with others") {
  const ThreeRanks ranks("svm");
  CHECK(ranks.film_with_on_last(beside_it) == ranks.film());
}

}  // namespace dmpc::tests::arithmetic_test

#endif
