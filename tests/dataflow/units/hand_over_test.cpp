// Units that are handed over, in every order of events, and what becomes of that when one rule is broken.

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "tests/dataflow/state_explorer.h"
#include "tests/dataflow/units/hand_over_model.h"

namespace dmpc::tests::hand_over_test {
namespace {

template <class Rules = HandOverRules>
StateReport explore_units(const HandOverSettings& settings) {
  const HandOverModel<Rules> model(settings);
  return StateExplorer(model).explore();
}

void check_all_orders(const HandOverSettings& settings, std::uint64_t states_min) {
  check_no_failure(explore_units(settings), states_min);
}

template <class Rules>
void check_found(const HandOverSettings& settings, const std::string& words) {
  check_failure(explore_units<Rules>(settings), words);
}

struct Dropping : HandOverRules {
  static constexpr bool sends_on = false;
};
struct CountingRaysAlone : HandOverRules {
  static constexpr bool counts_transfers = false;
};
struct CountingNoPrimaries : HandOverRules {
  static constexpr bool counts_primaries = false;
};
struct KeepingPrimaries : HandOverRules {
  static constexpr bool gives_primaries_away = false;
};
struct PassiveThoughWanting : HandOverRules {
  static constexpr bool active_until_content = false;
};
struct WokenByNews : HandOverRules {
  static constexpr bool news_wakes = true;
};
struct AnsweringTooEarly : HandOverRules {
  static constexpr bool answers_from_last_page = false;
};
struct AcknowledgingTooEarly : HandOverRules {
  static constexpr bool stores_before_acknowledging = false;
};
struct GivingPagesUp : HandOverRules {
  static constexpr bool keeps_pages = false;
};
struct AnsweringOn : HandOverRules {
  static constexpr bool giver_hands_over = false;
};
struct AskingAgain : HandOverRules {
  static constexpr bool asks_once = false;
};
struct GivingTwice : HandOverRules {
  static constexpr bool refuses_while_moving = false;
};
struct BelievingOldNews : HandOverRules {
  static bool is_news(std::uint32_t, std::uint32_t) { return true; }
};

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

TEST_CASE("a former owner that does not send rays on loses them") {
  check_found<Dropping>({.rays = {0, 1, 0}, .questions = 1}, "lost or doubled");
}

TEST_CASE("transfers that do not count let the end be announced while a unit is under way") {
  check_found<CountingRaysAlone>({.rays = {0, 0, 0}, .questions = 1}, "no unit is under way");
}

TEST_CASE("primary rays that do not count let the end be announced while they are under way") {
  check_found<CountingNoPrimaries>({.rays = {0, 0, 0}, .held = {1, 0, 0}, .questions = 1}, "no ray is left");
}

TEST_CASE("a node that starts primary rays that it has handed over starts them twice") {
  check_found<KeepingPrimaries>({.rays = {0, 0, 0}, .held = {1, 0, 0}, .questions = 1}, "lost or doubled");
}

TEST_CASE("a node that is passive though it wants to ask lets the end be announced too early") {
  check_found<PassiveThoughWanting>({.rays = {0, 0, 0}, .questions = 1}, "nobody will ask");
}

TEST_CASE("a node that news sets asking lets the end be announced too early" * doctest::test_suite("slow")) {
  check_found<WokenByNews>({.rays = {0, 1, 0}, .questions = 2}, "nobody will ask");
}

TEST_CASE("a node that answers for a unit before its last page has nothing to trace in") {
  check_found<AnsweringTooEarly>({.rays = {0, 0, 0}, .held = {0, 1, 0}, .questions = 1}, "where the unit's pages are");
}

TEST_CASE("a node that acknowledges the last page before it has stored it leaves nobody to answer for the unit") {
  check_found<AcknowledgingTooEarly>({.rays = {0, 1, 0}, .questions = 1}, "somebody answers");
}

TEST_CASE("a giver that gives the pages up has nothing to trace rays in that walk there") {
  check_found<GivingPagesUp>({.rays = {1, 0, 0}, .questions = 1}, "where the unit's pages are");
}

TEST_CASE("a giver that answers on leaves a unit with two owners") {
  check_found<AnsweringOn>({.rays = {0, 0, 0}, .questions = 1}, "one node answers");
}

TEST_CASE("nodes that ask again and again for the same rays do so for ever") {
  check_found<AskingAgain>({.rays = {0, 0, 0}, .questions = 1}, "circle");
}

TEST_CASE("a node that gives while it moves another unit has two transfers under way") {
  check_found<GivingTwice>({.rays = {0, 0, 0}, .questions = 2}, "one transfer under way");
}

TEST_CASE("a node that believes old news answers for a unit that is another's" * doctest::test_suite("slow")) {
  check_found<BelievingOldNews>({.rays = {0, 1, 0}, .questions = 2}, "one node answers");
}

}  // namespace dmpc::tests::hand_over_test
