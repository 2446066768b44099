#include "apps/edge/manual/completion.h"

#include <doctest/doctest.h>

#include <set>
#include <sstream>

#include "apps/edge/manual/leaves.h"
#include "apps/main/commands.h"
#include "tests/apps/manual/painter.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::completion_test {

namespace {

using tests::run;
using tests::Said;

/// A folder with a script, a picture and another folder, in which lines are completed.
class Desk {
 public:
  explicit Desk(const std::string& script) {
    tests::write_text(folder_ / "script", script);
    tests::write_text(folder_ / "hoard.nff", "");
    tests::write_text(folder_ / "hoard.png", "");
    std::filesystem::create_directory(folder_ / "stable");
  }

  /// What bash offers for the last of the words into which it cuts a line, with blanks between.
  std::string by_bash(const std::string& words) const {
    const std::string last = words.back() == ' ' ? "''" : "";
    return said(run({"bash", "--norc", "-c",
                     "cd '" + folder_.path().string() + "' && source ./script && COMP_WORDS=(" + words + last +
                         ") && COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && _dmpc && echo \"${COMPREPLY[*]}\""}));
  }

 private:
  static std::string said(const Said& all) {
    CHECK(all.errors.empty());
    return all.output.substr(0, all.output.find_last_not_of('\n') + 1);
  }

  tests::TemporaryFolder folder_;
};

const CommandDescription& program() {
  static const CommandDescription painter = tests::Painter().line.describe();
  return painter;
}

/// Files come in the order of their folder.
std::string in_order(const std::string& offered) {
  std::istringstream stream(offered);
  std::set<std::string> words;
  for (std::string word; stream >> word;) {
    words.insert(word);
  }
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

}  // namespace

TEST_CASE("bash completes commands, and commands of commands") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc ") == "paint mix");
  CHECK(desk.by_bash("dmpc pa") == "paint");
  CHECK(desk.by_bash("dmpc mix ") == "oil water");
  CHECK(desk.by_bash("dmpc mix o") == "oil");
  CHECK(desk.by_bash("dmpc nonsense").empty());
}

TEST_CASE("bash completes the options of the command given") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc paint --") == "--help --colour= --spare= --coats= --wet --frame=");
  CHECK(desk.by_bash("dmpc mix oil --w") == "--wet");
  CHECK(desk.by_bash("dmpc mix water --w").empty());
}

TEST_CASE("bash completes a value behind an option, with or without a sign of equality") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc paint --colour = ") == "red green dusk");
  CHECK(desk.by_bash("dmpc paint --colour =") == "red green dusk");
  CHECK(desk.by_bash("dmpc paint --colour = g") == "green");
  CHECK(desk.by_bash("dmpc paint --colour g") == "green");
  CHECK(desk.by_bash("dmpc paint --coats = ").empty());
}

TEST_CASE("bash completes the last word of a list") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc paint --spare = door,s") == "door,sill");
}

TEST_CASE("bash completes arguments by words and files, whatever options stand before") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc paint ho") == "house horse hoard.nff");
  CHECK(desk.by_bash("dmpc paint --coats 3 --wet hou") == "house");
  CHECK(in_order(desk.by_bash("dmpc mix water -o ho")) == "hoard.nff hoard.png");
  CHECK(desk.by_bash("dmpc mix water ho").empty());
}

TEST_CASE("bash completes an argument by files that can be one, and by folders") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc paint hoa") == "hoard.nff");
  CHECK(desk.by_bash("dmpc paint st") == "stable");
}

TEST_CASE("bash completes a word, and behind its colon a file") {
  const Desk desk(bash_completion(program()));
  CHECK(desk.by_bash("dmpc paint --frame = o") == "oak:");
  CHECK(in_order(desk.by_bash("dmpc paint --frame = oak : ho")) == "hoard.nff hoard.png");
  CHECK(in_order(desk.by_bash("dmpc paint --frame = oak :")) == "hoard.nff hoard.png script stable");
  CHECK(desk.by_bash("dmpc paint --frame = ash : ho").empty());
}

TEST_CASE("bash completes a value that has a sign") {
  const Desk desk(bash_completion(describe_command_line()));
  CHECK(desk.by_bash("dmpc render --up = -") == "-x -y -z");
}

TEST_CASE("bash knows all of dmpc's commands and options") {
  const CommandDescription dmpc = describe_command_line();
  const Desk desk(bash_completion(dmpc));
  for (const char* const path : {"render", "study balance", "bench speed"}) {
    const std::string offered = " " + desk.by_bash("dmpc " + std::string(path) + " -") + " ";
    for (const Leaf& leaf : leaves_of(dmpc)) {
      for (const OptionDescription& option : leaf.command->options) {
        const std::string word = " " + option.names.back() + (option.value.empty() ? " " : "= ");
        CHECK_MESSAGE((leaf.path != path || offered.find(word) != std::string::npos), word);
      }
    }
  }
  CHECK(desk.by_bash("dmpc render tea") == "teapot-12");
  CHECK(desk.by_bash("dmpc study paper -o ") == "stable");
  CHECK(desk.by_bash("dmpc machine ips") == "ipsc2 ipsc860");
}

}  // namespace dmpc::apps::completion_test
