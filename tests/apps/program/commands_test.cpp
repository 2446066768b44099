#include "apps/commands.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/text.h"

namespace dmpc::apps {

using namespace core;

using tests::contains;

namespace {

Command parse(std::initializer_list<std::string> arguments) { return parse_command_line(std::vector<std::string>(arguments)); }

std::string command_complaint(std::initializer_list<std::string> arguments) {
  try {
    parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("scene, check and compare take their own options") {
  const auto scene = std::get<SceneOptions>(parse({"scene", "rings-4-t1"}));
  CHECK(scene.name == "rings-4-t1");
  CHECK_FALSE(scene.output);
  CHECK(std::get<SceneOptions>(parse({"scene", "balls-4", "-o", "b.nff"})).output == "b.nff");
  const auto check = std::get<CheckOptions>(parse({"check", "tetra-6", "--list=3", "--brute-force=100", "--resolution=8x8"}));
  CHECK(check.picture.scene == "tetra-6");
  CHECK(check.list == 3);
  CHECK(check.brute_force == 100);
  const auto compare = std::get<CompareOptions>(parse({"compare", "a.exr", "b.exr", "--difference=d.png"}));
  CHECK(compare.picture == "a.exr");
  CHECK(compare.reference == "b.exr");
  CHECK(compare.difference == "d.png");
}

TEST_CASE("machine takes a name") {
  CHECK(std::get<MachineOptions>(parse({"machine", "cm5"})).machine == "cm5");
  CHECK(contains(command_complaint({"machine"}), "Try: dmpc machine --help"));
  CHECK(contains(std::get<HelpText>(parse({"machine", "--help"})).text, "ipsc2, ipsc860, paragon, cm5, cs2, gigabit, hdr"));
}

TEST_CASE("help shows examples and every command") {
  const std::string general = std::get<HelpText>(parse({"--help"})).text;
  for (const std::string word : {"render", "scene", "check", "compare", "machine", "study", "dmpc render teapot-12"}) {
    CHECK_MESSAGE(contains(general, word), word);
  }
}

TEST_CASE("the version can be asked for") { CHECK(std::get<HelpText>(parse({"--version"})).text.find("dmpc ") == 0); }

TEST_CASE("help is given about one thing, and words that are none of it are refused") {
  CHECK(contains(command_complaint({"help", "render", "x", "y"}),
                 "there is no help about 'x' of render: expected dmpc help render"));
  CHECK(contains(command_complaint({"help", "study", "cache", "x"}), "'x' of study cache"));
  CHECK(contains(command_complaint({"help", "glossary", "page"}), "there is no help about 'page' of glossary"));
  CHECK(contains(command_complaint({"help", "study", "x"}), "x is no command"));
  CHECK_NOTHROW(parse({"help", "study", "cache"}));
  CHECK_NOTHROW(parse({"help", "study"}));
  CHECK_NOTHROW(parse({"help"}));
}

TEST_CASE("wrong usage ends with a hint at the command's help") {
  CHECK(contains(command_complaint({}), "Try: dmpc --help"));
  CHECK(contains(command_complaint({"draw"}), "draw is no command"));
  CHECK(contains(command_complaint({"draw"}), "Try: dmpc --help"));
  CHECK(contains(command_complaint({"render"}), "Try: dmpc render --help"));
  CHECK(contains(command_complaint({"render", "teapot-12"}), "Try: dmpc render --help"));
  CHECK(contains(command_complaint({"render", "-o", "a.png"}), "SCENE"));
  CHECK(contains(command_complaint({"compare", "a.exr"}), "Try: dmpc compare --help"));
  CHECK(contains(command_complaint({"scene"}), "SCENE"));
}

TEST_CASE("every command that shows progress can be told not to") {
  for (const CommandDescription& command : describe_command_line().commands) {
    for (const CommandDescription& inner : command.commands) {
      CHECK_MESSAGE(std::any_of(inner.options.begin(), inner.options.end(),
                                [](const OptionDescription& option) { return option.names.back() == "--quiet"; }),
                    inner.name);
    }
  }
  CHECK(std::get<CheckOptions>(parse_command_line(std::vector<std::string>{"check", "tetra-3", "--quiet"})).quiet);
  CHECK_FALSE(std::get<CheckOptions>(parse_command_line(std::vector<std::string>{"check", "tetra-3"})).quiet);
}

}  // namespace dmpc::apps
