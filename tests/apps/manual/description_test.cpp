#include "apps/frontend/line/command_description.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "apps/main/commands.h"
#include "tests/apps/manual/painter.h"

namespace dmpc::apps::description_test {

namespace {

using Words = std::vector<std::string>;

CommandDescription paint() { return tests::Painter().line.describe().commands.front(); }

}  // namespace

TEST_CASE("a description has commands, arguments and options in the order of their declaration") {
  const CommandDescription program = tests::Painter().line.describe();
  REQUIRE(program.commands.size() == 2);
  CHECK(program.commands[0].name == "paint");
  CHECK(program.commands[0].text == "Paints a \"picture\"");
  CHECK(program.commands[1].commands[1].name == "water");
  REQUIRE(program.commands[0].arguments.size() == 1);
  CHECK(program.commands[0].arguments[0].is_required);
  REQUIRE(program.commands[0].options.size() == 6);
  CHECK(program.commands[0].options[0].names == Words{"-h", "--help"});
  CHECK(program.commands[0].options[3].names == Words{"-c", "--coats"});
  CHECK(program.commands[0].options[3].value == "1..5 [2]");
  CHECK(program.commands[0].options[4].value.empty());
}

TEST_CASE("what stands for a value is suggested as it stands, and by the meaning of its name") {
  const CommandDescription command = paint();
  CHECK(command.arguments[0].suggestion.words == Words{"house", "horse"});
  CHECK(command.arguments[0].suggestion.files);
  CHECK(command.options[1].suggestion.words == Words{"red", "green", "dusk"});
  CHECK_FALSE(command.options[1].suggestion.files);
}

TEST_CASE("nothing is suggested for a number") {
  CHECK(paint().options[3].suggestion.words.empty());
  CHECK_FALSE(paint().options[3].suggestion.files);
}

TEST_CASE("words with commas between are a list, a choice is none") {
  CHECK(paint().options[2].is_list);
  CHECK_FALSE(paint().options[1].is_list);
}

TEST_CASE("the program's description has built-in scenes, machines, files and folders") {
  const CommandDescription program = describe_command_line();
  const CommandDescription& render = program.commands.front();
  const Words scenes = render.arguments.front().suggestion.words;
  CHECK(std::count(scenes.begin(), scenes.end(), "teapot-12") == 1);
  CHECK(render.arguments.front().suggestion.files);
  for (const OptionDescription& option : render.options) {
    CHECK_FALSE(option.text.empty());
    if (option.names.back() == "--up") {
      CHECK(option.suggestion.words == Words{"x", "y", "z", "-x", "-y", "-z"});
    }
    if (option.names.back() == "--machine") {
      CHECK(option.suggestion.words.front() == "ipsc2");
      CHECK(option.suggestion.files);
    }
    if (option.names.back() == "--heatmap") {
      CHECK(option.suggestion.words.front() == "faults:");
    }
  }
  const Words endings = render.arguments.front().suggestion.endings;
  CHECK(std::count(endings.begin(), endings.end(), "nff") == 1);
  CHECK(std::count(endings.begin(), endings.end(), "glb") == 1);
  CHECK(std::count(endings.begin(), endings.end(), "png") == 0);
}

TEST_CASE("help is offered about every command, and about words") {
  const CommandDescription program = describe_command_line();
  const auto help = std::find_if(program.commands.begin(), program.commands.end(),
                                 [](const CommandDescription& command) { return command.name == "help"; });
  REQUIRE(help != program.commands.end());
  const Words topics = help->arguments.front().suggestion.words;
  for (const CommandDescription& command : program.commands) {
    CHECK_MESSAGE((command.name == "help" || std::count(topics.begin(), topics.end(), command.name) == 1), command.name);
  }
  CHECK(std::count(topics.begin(), topics.end(), "glossary") == 1);
}

}  // namespace dmpc::apps::description_test
