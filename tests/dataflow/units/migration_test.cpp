// Units that are migrated, in every order of events, and what becomes of that when one rule is broken.

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/dataflow/state_explorer.h"
#include "tests/dataflow/units/migration_model.h"

namespace dmpc::tests::migration_test {
namespace {

StateReport explore_units(const MigrationSettings& settings) {
  const MigrationModel model(settings);
  return StateExplorer(model).explore();
}

void check_all_orders(const MigrationSettings& settings, std::uint64_t states_min) {
  check_no_failure(explore_units(settings), states_min);
}

/// What becomes of it when a rule is broken, and what is said then.
struct Broken {
  const char* sentence;
  MigrationSettings settings;
  const char* words;
};

void check_found(const std::vector<Broken>& all) {
  for (const Broken& broken : all) {
    CAPTURE(std::string(broken.sentence));
    check_failure(explore_units(broken.settings), broken.words);
  }
}

}  // namespace

TEST_CASE("rays for a unit that nobody asks for end") { check_all_orders({.rays = {0, 1, 1}, .questions = 0}, 50); }

TEST_CASE("a unit that moves loses no ray in any order of events, and the end is proved then and only then" *
          doctest::test_suite("slow")) {
  check_all_orders({.rays = {0, 0, 0}, .questions = 3}, 10'000);
  check_all_orders({.rays = {1, 0, 0}, .questions = 2}, 10'000);
  check_all_orders({.rays = {0, 1, 0}, .questions = 2}, 10'000);
  check_all_orders({.rays = {0, 1, 1}, .questions = 1}, 10'000);
  check_all_orders({.rays = {0, 0, 0}, .held = {0, 1, 0}, .questions = 2}, 10'000);
  check_all_orders({.rays = {0, 0, 0}, .held = {2, 0, 0}, .questions = 2}, 10'000);
}

TEST_CASE("a hand-over with any one rule broken is found out") {
  check_found({
      {"a former owner that does not send rays on loses them",
       {.rays = {0, 1, 0}, .questions = 1, .rules = {.sends_on = false}},
       "lost or doubled"},
      {"transfers that do not count let the end be announced while a unit is under way",
       {.rays = {0, 0, 0}, .questions = 1, .rules = {.counts_transfers = false}},
       "no unit is under way"},
      {"primary rays that do not count let the end be announced while they are under way",
       {.rays = {0, 0, 0}, .held = {1, 0, 0}, .questions = 1, .rules = {.counts_primaries = false}},
       "no ray is left"},
      {"a node that starts primary rays that it has migrated starts them twice",
       {.rays = {0, 0, 0}, .held = {1, 0, 0}, .questions = 1, .rules = {.gives_primaries_away = false}},
       "lost or doubled"},
      {"a node that is passive though it wants to ask lets the end be announced too early",
       {.rays = {0, 0, 0}, .questions = 1, .rules = {.active_until_content = false}},
       "nobody will ask"},
      {"a node that answers for a unit before its last page has nothing to trace in",
       {.rays = {0, 0, 0}, .held = {0, 1, 0}, .questions = 1, .rules = {.answers_from_last_page = false}},
       "where the unit's pages are"},
      {"a node that acknowledges the last page before it has stored it leaves nobody to answer for the unit",
       {.rays = {0, 1, 0}, .questions = 1, .rules = {.stores_before_acknowledging = false}},
       "somebody answers"},
      {"a donor that gives the pages up has nothing to trace rays in that walk there",
       {.rays = {1, 0, 0}, .questions = 1, .rules = {.keeps_pages = false}},
       "where the unit's pages are"},
      {"a donor that answers on leaves a unit with two owners",
       {.rays = {0, 0, 0}, .questions = 1, .rules = {.donor_migrates = false}},
       "one node answers"},
      {"nodes that ask again and again for the same rays do so for ever",
       {.rays = {0, 0, 0}, .questions = 1, .rules = {.asks_once = false}},
       "circle"},
      {"a node that gives while it moves another unit has two transfers under way",
       {.rays = {0, 0, 0}, .questions = 2, .rules = {.refuses_while_moving = false}},
       "one transfer under way"},
  });
}

TEST_CASE("a hand-over with a rule broken that many orders of events hide is found out" * doctest::test_suite("slow")) {
  check_found({
      {"a node that news sets asking lets the end be announced too early",
       {.rays = {0, 1, 0}, .questions = 2, .rules = {.news_wakes = true}},
       "nobody will ask"},
      {"a node that believes old news answers for a unit that is another's",
       {.rays = {0, 1, 0}, .questions = 2, .rules = {.believes_old_news = true}},
       "one node answers"},
  });
}

}  // namespace dmpc::tests::migration_test
