// The manual page, and what groff says of it.

#include <doctest/doctest.h>

#include <regex>
#include <string>

#include "apps/main/commands.h"
#include "tests/apps/manual/leaves.h"
#include "tests/apps/manual/painter.h"
#include "tests/apps/manual/written.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::man_page_test {

namespace {

using tests::contains;
using tests::count;

std::string page_of(const CommandDescription& program) { return tests::written(program, "dmpc.1"); }

std::string painter_page() { return page_of(tests::Painter().line.describe()); }

/// What the page says of a command.
std::string part_of(const std::string& page, const std::string& command) {
  const std::string title = ".SS \"dmpc " + command + "\"\n";
  REQUIRE(count(page, title) == 1);
  const std::string rest = page.substr(page.find(title) + title.size());
  return rest.substr(0, rest.find("\n.S"));
}

/// What groff says of a page, all its warnings on.
std::string complaints(const std::string& page) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "page", page);
  const tests::Said said = tests::run({"groff", "-man", "-ww", "-z", "-Tutf8", folder / "page"});
  return said.errors + (said.status == 0 ? "" : "it failed");
}

}  // namespace

TEST_CASE("a page has each command in a part of its own") {
  CHECK(contains(part_of(painter_page(), "paint"), "Paints a \\(dqpicture\\(dq."));
  CHECK(contains(part_of(painter_page(), "mix oil"), "Slowly."));
  CHECK_FALSE(contains(painter_page(), ".SS \"dmpc mix\""));
}

TEST_CASE("an option is explained once, and referred to where another command has it") {
  CHECK(count(painter_page(), "On wet ground") == 1);
  CHECK(contains(part_of(painter_page(), "paint"), "\\fB\\-\\-wet\\fP\nOn wet ground"));
  CHECK(contains(part_of(painter_page(), "mix oil"), "As in dmpc paint: \\-\\-wet."));
}

TEST_CASE("a page shows calls as examples, and other remarks with their command") {
  CHECK(contains(painter_page(), ".SH \"EXAMPLES\"\n.nf\ndmpc paint house \\-\\-wet\n"));
  CHECK(contains(part_of(painter_page(), "paint"), "Paint dries slowly."));
  CHECK_FALSE(contains(part_of(painter_page(), "paint"), "dmpc paint house"));
}

TEST_CASE("the synopsis says what must be given") {
  CHECK(contains(painter_page(), "\\fBdmpc paint\\fP\\fI PICTURE [OPTION]...\\fP"));
}

TEST_CASE("nothing of a text is taken for a request, an escape or a quotation mark, and what is copied can be typed") {
  const auto said_of = [](const std::string& text) {
    const std::string page =
        page_of({.name = "p", .text = "p: x", .options = {{.names = {"-x"}, .value = {}, .text = text, .group = {}}}});
    const std::string before = ".TP\n\\fB\\-x\\fP\n";
    const std::string rest = page.substr(page.find(before) + before.size());
    return rest.substr(0, rest.find(".PP\n"));
  };
  CHECK(said_of("Two words: 1,5 (and so on)") == "Two words: 1,5 (and so on)\n");
  CHECK(said_of("a\n.br.") == "a\n.br\n\\&.br.\n");
  CHECK(said_of("a\\fB") == "a\\(rsfB\n");
  CHECK(said_of("'br \"a\"") == "\\(aqbr \\(dqa\\(dq\n");
  CHECK(said_of("--a=`b`~^") == "\\-\\-a=\\(gab\\(ga\\(ti\\(ha\n");
  CHECK(said_of(std::string(77, 'a') + " .b") == std::string(77, 'a') + "\n\\&.b\n");
}

TEST_CASE("groff has nothing to say about the pages") {
  CHECK(complaints(painter_page()).empty());
  CHECK(complaints(page_of(describe_command_line())).empty());
  CHECK_FALSE(complaints(".nonsense\n").empty());
}

TEST_CASE("dmpc's page has all its sections, commands and options") {
  const CommandDescription program = describe_command_line();
  const std::string page = page_of(program);
  for (const char* const title :
       {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "COMMANDS", "EXAMPLES", "EXIT STATUS", "ENVIRONMENT", "SEE ALSO"}) {
    CHECK_MESSAGE(count(page, ".SH \"" + std::string(title) + "\"\n") == 1, title);
  }
  for (const tests::Leaf& leaf : tests::leaves_of(program)) {
    const std::string part = part_of(page, leaf.path);
    for (const OptionDescription& option : leaf.command->options) {
      const std::string name = option.names.back();
      CHECK_MESSAGE((name == "--help" || contains(part, std::regex_replace(name, std::regex("-"), "\\-"))),
                    leaf.path << ' ' << name);
    }
  }
}

}  // namespace dmpc::apps::man_page_test
