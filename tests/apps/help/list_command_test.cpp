#include "apps/help/list_command.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "apps/frontend/machine/machines.h"
#include "apps/help/choices.h"
#include "apps/main/commands.h"
#include "apps/scene/load_scene.h"
#include "tests/support/text.h"

namespace dmpc::apps::list_command_test {

namespace {

std::string list_of(const ListOptions& options) {
  std::ostringstream output;
  Interrupt interrupt;
  CHECK(list_command(options, interrupt, output) == 0);
  return output.str();
}

const ChoiceList& choices_of(const std::vector<ChoiceList>& all, const std::string& kind) {
  for (const ChoiceList& one : all) {
    if (one.kind == kind) {
      return one;
    }
  }
  FAIL("no list of " << kind);
  return all.front();
}

}  // namespace

TEST_CASE("every word listed is known by the option that takes it, and has a meaning") {
  for (const ChoiceList& one : all_choices()) {
    std::set<std::string> names;
    for (const Choice& entry : one.entries) {
      CHECK_MESSAGE(names.insert(entry.name).second, entry.name);
      CHECK_MESSAGE(!entry.meaning.empty(), entry.name);
    }
  }
  const auto all = all_choices();
  for (const Choice& entry : choices_of(all, "machines").entries) {
    CHECK(find_machine_preset(entry.name) != nullptr);
  }
  for (const auto& [kind, rest] : {std::pair{"policies", ""}, {"strategies", ""}, {"skips", ""}, {"heatmaps", "a.png"}}) {
    for (const Choice& entry : choices_of(all, kind).entries) {
      const std::string option = choices_of(all, kind).where + entry.name + (*rest == 0 ? "" : ":") + rest;
      CHECK_NOTHROW(parse_command_line(std::vector<std::string>{"render", "tetra-3", "-o", "b.png", option}));
    }
  }
}

TEST_CASE("lists are printed in the order asked for, or all of them") {
  const std::string some = list_of({.kinds = {"policies", "machines"}});
  CHECK(some.starts_with("policies (--replacement=)\n  lru"));
  CHECK(some.find("ipsc2") > some.find("random"));
  CHECK_FALSE(tests::contains(some, "teapot-12"));
  const std::string all = list_of({});
  REQUIRE(all_choices().size() == choice_kinds.size());
  for (std::size_t i = 0; i < choice_kinds.size(); ++i) {
    const ChoiceList one = all_choices()[i];
    CHECK(one.kind == choice_kinds[i]);
    CHECK(tests::contains(all, one.kind + " (" + one.where + ")\n"));
  }
}

TEST_CASE("each skip says what it skips and where that gains") {
  const std::string some = list_of({.kinds = {"skips"}});
  CHECK(tests::contains(some,
                        "that are known to have none left (svm, replicated, forest). Leaves 0.9 of the requests on 8 nodes, "));
  CHECK(tests::contains(some, "equal-frames   a frame that equals the one before it is a copy of its picture"));
  const auto all = all_choices();
  for (const Choice& skip : choices_of(all, "skips").entries) {
    CHECK_MESSAGE(tests::contains(skip.meaning, ". Leaves "), skip.name);
  }
}

TEST_CASE("a list as JSON has a row a word") {
  const auto json = nlohmann::json::parse(list_of({.kinds = {"machines"}, .format = ListFormat::json}));
  REQUIRE(json["rows"].size() == machine_presets().size());
  CHECK(json["rows"][0]["kind"] == "machines");
  CHECK(json["rows"][0]["name"] == "ipsc2");
  CHECK(tests::contains(json["rows"][0]["meaning"].get<std::string>(), "Intel iPSC/2"));
}

}  // namespace dmpc::apps::list_command_test
