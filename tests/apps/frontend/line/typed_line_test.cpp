// What newcomers type wrong, and what they read then.

#include "apps/frontend/line/typed_line.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/line/words.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::typed_line_test {

namespace {

using Words = std::vector<std::string>;

/// The words of a line; '' is an empty one.
Words typed(const std::string& line) {
  Words words = words_between(line, ' ');
  for (std::string& word : words) {
    word = word == "''" ? "" : word;
  }
  return words;
}

std::string answer_to(const std::string& line) {
  const std::string complaint = tests::usage_complaint(typed(line));
  return complaint.empty() ? "nothing" : complaint;
}

}  // namespace

TEST_CASE("what is typed wrong is answered by what is wrong, what was expected, and where help is") {
  for (const tests::Refusal& slip : tests::refusals_in("apps/frontend/line/slips.txt")) {
    const std::string answer = answer_to(slip.line);
    CHECK_MESSAGE(tests::contains(answer, slip.complaint), "dmpc " << slip.line << "\n  says: " << answer);
    CHECK_MESSAGE(tests::contains(answer, "\nTry: dmpc "), answer);
    CHECK_MESSAGE(tests::contains(answer, " --help"), answer);
  }
}

TEST_CASE("what is typed in other ways is taken as the same") {
  const auto words_of = [](const std::string& line) { return read_line(describe_command_line(), typed(line)).words; };
  const Words words = words_of("render teapot-12 --output=a.png --nodes=4 --quiet");
  CHECK(words == Words{"render", "--output=a.png", "--nodes=4", "--quiet", "--", "teapot-12"});
  CHECK(words_of("render -o a.png --nodes 4 --quiet teapot-12") == words);
  CHECK(words_of("render -oa.png --nodes=4 --quiet -- teapot-12") == words);
  CHECK(words_of("compare -- -a.exr --b.exr") == Words{"compare", "--", "-a.exr", "--b.exr"});
}

TEST_CASE("what begins like a short option is a value, where it is no option") {
  const TypedLine line = read_line(describe_command_line(), typed("render a --camera -1,2,3/0,0,0 -o -"));
  CHECK(line.words == Words{"render", "--camera=-1,2,3/0,0,0", "--output=-", "--", "a"});
}

TEST_CASE("an option that may be given several times and a flag may") {
  CHECK(answer_to("render teapot-12 -o a.png --light=1,2,3 --light=4,5,6 --quiet --quiet") == "nothing");
}

TEST_CASE("help is given whatever else is wrong, but not about a command that there is none") {
  for (const char* const line : {"render --help", "render --nods=4 --help", "render -o -h", "render a b c --nodes= --help"}) {
    const TypedLine read = read_line(describe_command_line(), typed(line));
    CHECK_MESSAGE(read.asks_for_help, line);
    CHECK(read.command == "render");
  }
  CHECK(read_line(describe_command_line(), typed("study cache -h")).command == "study cache");
  CHECK(read_line(describe_command_line(), typed("--help")).command.empty());
  CHECK(tests::contains(answer_to("rendr --help"), "Did you mean render?"));
  CHECK(tests::contains(answer_to("study balanse --help"), "Did you mean balance?"));
}

TEST_CASE("the version is told whatever follows") {
  CHECK(parse_command_line(typed("--version")).options<HelpText>().text.starts_with("dmpc "));
  CHECK(tests::contains(answer_to("--verison"), "Did you mean --version?"));
}

TEST_CASE("help about a command is what the command says of itself, and about words the glossary") {
  const auto text = [](const std::string& line) { return parse_command_line(typed(line)).options<HelpText>().text; };
  CHECK(text("help render") == text("render --help"));
  CHECK(text("help study cache") == text("study cache --help"));
  CHECK(text("help") == text("--help"));
  CHECK(tests::contains(text("help glossary"), "work item"));
}

TEST_CASE("a word that tables show or an option takes is explained, in each of its meanings") {
  const auto text = [](const std::string& line) { return parse_command_line(typed(line)).options<HelpText>().text; };
  CHECK(text("help page").starts_with("page: "));
  CHECK(text("help Pages").starts_with("page: "));
  CHECK(text("help page wait").starts_with("wait: "));
  CHECK(text("help hdr").starts_with("hdr (--machine=hdr): "));
  CHECK(text("help cache-pages").starts_with("dmpc render --cache-pages="));
  CHECK(tests::contains(text("help svm"), "\nsvm (--strategy=svm): "));
  CHECK(tests::contains(text("help svm"), "\nsvm (--system=svm): "));
  CHECK(tests::contains(answer_to("help submop"), "there is no help about 'submop'"));
  CHECK(tests::contains(answer_to("help submop"), "Did you mean submap?"));
}

TEST_CASE("help is in two sizes where a command says which options matter first, and what it names there is one") {
  const CommandDescription program = describe_command_line();
  const auto text = [](const std::string& line) { return parse_command_line(typed(line)).options<HelpText>().text; };
  const std::string brief = text("render --help");
  CHECK(std::count(brief.begin(), brief.end(), '\n') < 40);
  CHECK(text("render --help=all").size() > 4 * brief.size());
  CHECK(text("list --help") == text("list --help=all"));
  for (const CommandDescription& command : program.commands) {
    for (const BriefGroup& group : command.brief) {
      for (const auto& [name, meaning] : group.rows) {
        const std::string word = name.substr(0, name.find_first_of(", "));
        CHECK_MESSAGE(
            std::ranges::any_of(command.options,
                                [&](const OptionDescription& option) { return std::ranges::count(option.names, word) == 1; }),
            name);
        CHECK_FALSE(meaning.empty());
      }
    }
  }
}

}  // namespace dmpc::apps::typed_line_test
