#include "apps/lab/bench/stability/state.h"

#include <doctest/doctest.h>

#include <fstream>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::state_test {

using apps::StabilityState;

namespace {

StabilityState two_rows() {
  StabilityState state;
  state.rows = {{"R1 one"}, {"R2 two"}};
  state.trials = {{"R1 one", "a"}, {"R2 two", "b"}};
  return state;
}

StabilityState half_done() {
  StabilityState state = two_rows();
  state.case_index = 3;
  state.rays_done = 2048;
  state.rows[0].counts[2] = {1, 2, 3, 4, 5, 6, 7};
  state.rows[1].counts[9] = {10, 0, 0, 0, 0, 0, 1, 3, 4, 5};
  state.trials[1].counts = {11, 0, 0, 0, 0, 0, 1, 3, 4, 5};
  return state;
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("a state that is saved and loaded is the same") {
  const TemporaryFolder folder;
  apps::save_state(folder / "state", half_done(), "seed 1");
  StabilityState state = two_rows();
  apps::load_state(folder / "state", state, "seed 1");
  CHECK(apps::text_of(state, "seed 1") == apps::text_of(half_done(), "seed 1"));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a state whose file is not there yet is where a run starts") {
  const TemporaryFolder folder;
  StabilityState state = two_rows();
  apps::load_state(folder / "none", state, "seed 1");
  CHECK(apps::text_of(state, "seed 1") == apps::text_of(two_rows(), "seed 1"));
}

TEST_CASE("the state of a run with other options is refused with both") {
  const TemporaryFolder folder;
  apps::save_state(folder / "state", half_done(), "seed 1");
  StabilityState state = two_rows();
  CHECK_THROWS_WITH_AS(apps::load_state(folder / "state", state, "seed 2"), doctest::Contains("(seed 1), expected seed 2"),
                       core::InputError);
}

TEST_CASE("a file that is no state or a damaged one is refused") {
  const TemporaryFolder folder;
  const std::string good = apps::text_of(half_done(), "seed 1");
  const std::string head = good.substr(0, good.find("3 2048"));
  for (const std::string& text : {std::string(), std::string("nff\nv\n"), head, head + "x 0 0\n",
                                  head + "0 0 1\n9 0 1 0 0 0 0 0 0\n", head + "0 0 1\n0 99 1 0 0 0 0 0 0\n",
                                  head + "0 0 1\n0 0 1 0 0 0 0 0 12", head + "0 0 2\n0 0 1 0 0 0 0 0 0\n", good + "more"}) {
    CAPTURE(text);
    write(folder / "state", text);
    StabilityState state = two_rows();
    CHECK_THROWS_AS(apps::load_state(folder / "state", state, "seed 1"), core::InputError);
  }
}

}  // namespace dmpc::tests::state_test
