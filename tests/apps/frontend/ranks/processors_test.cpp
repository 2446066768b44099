#include "apps/frontend/ranks/processors.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::processors_test {

namespace {

using apps::RankProcessors;

}  // namespace

TEST_CASE("processors are read as they were said") {
  for (const RankProcessors& processors :
       {RankProcessors{"a", {}}, RankProcessors{"b.example", {0}}, RankProcessors{"c", {3, 70}}}) {
    CHECK(apps::parse_processors(apps::text_of(processors)) == processors);
  }
  CHECK_THROWS_AS(apps::parse_processors("a 1 b"), core::InternalError);
  CHECK_THROWS_AS(apps::parse_processors(""), core::InternalError);
}

TEST_CASE("a process may use a processor at least") {
  CHECK(apps::own_processors("here").host == "here");
  CHECK(apps::own_processors("here").numbers.size() >= 1);
}

TEST_CASE("processors that several ranks of a host may use are shared among them") {
  const std::vector<RankProcessors> ranks = {
      {"a", {0, 1, 2, 3}}, {"a", {0, 1, 2, 3}}, {"a", {4}}, {"b", {0, 1, 2, 3}}, {"c", {}}};
  CHECK(apps::share_of_processors(ranks, 0) == 2.0);
  CHECK(apps::share_of_processors(ranks, 1) == 2.0);
  CHECK(apps::share_of_processors(ranks, 2) == 1.0);
  CHECK(apps::share_of_processors(ranks, 3) == 4.0);
  CHECK(apps::share_of_processors(ranks, 4) == 0.0);
}

TEST_CASE("where nobody says one processor of a rank's share is the communicating thread's, and one node is there at least") {
  CHECK(apps::default_nodes_on(8.0) == 7);
  CHECK(apps::default_nodes_on(2.0) == 1);
  CHECK(apps::default_nodes_on(1.0 / 3) == 1);
  CHECK(apps::default_nodes_on(0.0) == 1);
  const std::vector<RankProcessors> three(3, RankProcessors{"a", {0, 1, 2, 3, 4, 5, 6, 7, 8}});
  CHECK(apps::default_nodes_on(apps::share_of_processors(three, 0)) == 2);  // nine thirds, less one
}

TEST_CASE("where nobody says a communicating thread spins on a processor of its own, and sleeps where nodes want all") {
  CHECK(apps::default_idle(3.0, 2) == nodes::Idle::spin);
  CHECK(apps::default_idle(2.9, 2) == nodes::Idle::sleep);
  const std::vector<RankProcessors> three(3, RankProcessors{"a", {0, 1, 2, 3, 4, 5, 6, 7, 8}});
  CHECK(apps::default_idle(apps::share_of_processors(three, 0), 2) == nodes::Idle::spin);
}

}  // namespace dmpc::tests::processors_test
