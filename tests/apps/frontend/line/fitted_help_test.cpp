
#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>

#include "apps/frontend/line/help_text.h"
#include "apps/main/commands.h"
#include "tests/support/text.h"

namespace dmpc::apps::fitted_help_test {

namespace {

const std::string help =
    "Renders, and says with some words what became of that\n"
    "  --nodes 1..4096 [8]               Nodes of the computer, each of which is a thread\n"
    "  --a-long-name-of-an-option FILE [nothing]\n"
    "                                    Where something goes that nobody asks for\n"
    "  dmpc render a-scene-with-a-name-that-is-long.nff --nodes=8 --strategy=dataflow -o a.png\n";

}  // namespace

TEST_CASE("help that fits stays as it is") { CHECK(fitted_help(help, 200) == help); }

TEST_CASE("explanations go on below their beginning, and what is to be typed stays whole") {
  CHECK(fitted_help(help, 72) ==
        "Renders, and says with some words what became of that\n"
        "  --nodes 1..4096 [8]               Nodes of the computer, each of which\n"
        "                                    is a thread\n"
        "  --a-long-name-of-an-option FILE [nothing]\n"
        "                                    Where something goes that nobody\n"
        "                                    asks for\n"
        "  dmpc render a-scene-with-a-name-that-is-long.nff --nodes=8 --strategy=dataflow -o a.png\n");
}

TEST_CASE("where there is little room explanations stand below the names") {
  CHECK(fitted_help(help, 40) ==
        "Renders, and says with some words what\n"
        "became of that\n"
        "  --nodes 1..4096 [8]\n"
        "        Nodes of the computer, each of\n"
        "        which is a thread\n"
        "  --a-long-name-of-an-option FILE [nothing]\n"
        "        Where something goes that nobody\n"
        "        asks for\n"
        "  dmpc render a-scene-with-a-name-that-is-long.nff --nodes=8 --strategy=dataflow -o a.png\n");
}

TEST_CASE("no word of any command's help is lost") {
  const auto words = [](const std::string& text) {
    std::string all;
    std::copy_if(text.begin(), text.end(), std::back_inserter(all), [](char letter) { return letter != ' ' && letter != '\n'; });
    return all;
  };
  const std::string text = parse_command_line(std::vector<std::string>{"render", "--help=all"}).options<HelpText>().text;
  for (const std::size_t width : {1U, 40U, 80U, 132U}) {
    CHECK(words(fitted_help(text, width)) == words(text));
  }
}

TEST_CASE("what is written elsewhere than to a terminal is not folded") {
  std::ostringstream output;
  print_help(output, help);
  CHECK(output.str() == help);
}

}  // namespace dmpc::apps::fitted_help_test
