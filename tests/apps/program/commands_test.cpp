#include "apps/main/commands.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/machine/machine_command.h"
#include "apps/lab/check/command.h"
#include "apps/lab/compare/command.h"
#include "apps/scene/scene_command.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/text.h"

namespace dmpc::apps::commands_test {

using namespace core;

using tests::contains;

namespace {

Command parse(std::initializer_list<std::string> arguments) { return parse_command_line(std::vector<std::string>(arguments)); }

}  // namespace

TEST_CASE("compare takes two pictures or two files of counters, and each has options of its own") {
  const auto pictures = parse({"compare", "a", "b", "--fail-above=rmse:0.1", "--fail-above=max:1"}).options<CompareOptions>();
  CHECK(pictures.limits.size() == 2);
  const auto counters =
      parse({"compare", "a.json", "b.json", "--only=x", "--only=y", "--tolerance=z:1"}).options<CompareOptions>();
  CHECK(counters.figures.only.size() == 2);
  CHECK(counters.figures.tolerances.size() == 1);
}

TEST_CASE("scene, check and compare take their own options") {
  const auto scene = parse({"scene", "rings-4-t1"}).options<SceneOptions>();
  CHECK(scene.name == "rings-4-t1");
  CHECK_FALSE(scene.output);
  CHECK(parse({"scene", "balls-4", "-o", "b.nff"}).options<SceneOptions>().output == "b.nff");
  const auto kept = parse({"check", "grove-2", "--instances=keep"}).options<CheckOptions>();
  CHECK(kept.database.build.keeps_instances);
  CHECK(kept.database.build.structure == core::Structure::extents);
  CHECK(kept.picture.scene_setup.mesh.copies == core::Copies::put);  // for the oracle
  const auto check = parse({"check", "tetra-6", "--list=3", "--brute-force=100", "--resolution=8x8"}).options<CheckOptions>();
  CHECK(check.picture.scene == "tetra-6");
  CHECK(check.list == 3);
  CHECK(check.brute_force == 100);
  const auto compare = parse({"compare", "a.exr", "b.exr", "--difference=d.png"}).options<CompareOptions>();
  CHECK(compare.a == "a.exr");
  CHECK(compare.reference == "b.exr");
  CHECK(compare.difference == "d.png");
}

TEST_CASE("machine takes a name") {
  CHECK(parse({"machine", "cm5"}).options<MachineOptions>().machine == "cm5");
  CHECK(contains(parse({"machine", "--help"}).options<HelpText>().text,
                 "ipsc2, ipsc2-1994, ipsc860, paragon, cm5, cs2, myrinet, fdr, gigabit, hdr, ndr"));
}

TEST_CASE("help shows examples and every command") {
  const std::string general = parse({"--help"}).options<HelpText>().text;
  for (const std::string word : {"render", "scene", "check", "compare", "machine", "study", "dmpc render teapot-12"}) {
    CHECK_MESSAGE(contains(general, word), word);
  }
}

TEST_CASE("help is given about a command, a study, or all") {
  CHECK_NOTHROW(parse({"help", "study", "cache"}));
  CHECK_NOTHROW(parse({"help", "study"}));
  CHECK_NOTHROW(parse({"help"}));
}

TEST_CASE("the version can be asked for") { CHECK(parse({"--version"}).options<HelpText>().text.find("dmpc ") == 0); }

TEST_CASE("every command that shows progress can be told not to") {
  for (const CommandDescription& command : describe_command_line().commands) {
    for (const CommandDescription& inner : command.commands) {
      CHECK_MESSAGE(std::any_of(inner.options.begin(), inner.options.end(),
                                [](const OptionDescription& option) { return option.names.back() == "--quiet"; }),
                    inner.name);
    }
  }
  CHECK(parse_command_line(std::vector<std::string>{"check", "tetra-3", "--quiet"}).options<CheckOptions>().quiet);
  CHECK_FALSE(parse_command_line(std::vector<std::string>{"check", "tetra-3"}).options<CheckOptions>().quiet);
}

TEST_CASE("scene may be told to be quiet like the others") {
  const Command command = parse({"scene", "tetra-3", "--quiet"});
  CHECK(command.options<SceneOptions>().quiet);
  CHECK(command.is_quiet());
  CHECK_FALSE(parse({"scene", "tetra-3"}).is_quiet());
}

}  // namespace dmpc::apps::commands_test
