// Lines of commands, options and values as bash completes them.

#include <doctest/doctest.h>

#include <initializer_list>
#include <set>
#include <sstream>

#include "apps/main/commands.h"
#include "tests/apps/manual/leaves.h"
#include "tests/apps/manual/painter.h"
#include "tests/apps/manual/written.h"
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

TEST_CASE("bash completes commands, options, their values and arguments") {
  struct Completion {
    const char *words, *offered;
  };
  const Desk desk(tests::written(program(), "dmpc.bash"));
  for (const Completion& row : std::initializer_list<Completion>{
           {"dmpc ", "paint mix"},
           {"dmpc pa", "paint"},
           {"dmpc mix ", "oil water"},
           {"dmpc mix o", "oil"},
           {"dmpc nonsense", ""},
           // the options of the command given
           {"dmpc paint --", "--help --colour= --spare= --coats= --wet --frame="},
           {"dmpc mix oil --w", "--wet"},
           {"dmpc mix water --w", ""},
           // a value behind an option, with or without a sign of equality; the last word of a list
           {"dmpc paint --colour = ", "red green dusk"},
           {"dmpc paint --colour =", "red green dusk"},
           {"dmpc paint --colour = g", "green"},
           {"dmpc paint --colour g", "green"},
           {"dmpc paint --coats = ", ""},
           {"dmpc paint --spare = door,s", "door,sill"},
           // arguments by words, by files that can be one and by folders, whatever options stand before
           {"dmpc paint ho", "house horse hoard.nff"},
           {"dmpc paint --coats 3 --wet hou", "house"},
           {"dmpc mix water ho", ""},
           {"dmpc paint hoa", "hoard.nff"},
           {"dmpc paint st", "stable"}}) {
    CHECK_MESSAGE(desk.by_bash(row.words) == row.offered, row.words);
  }
  CHECK(in_order(desk.by_bash("dmpc mix water -o ho")) == "hoard.nff hoard.png");
}

TEST_CASE("bash completes a word, and behind its colon a file") {
  const Desk desk(tests::written(program(), "dmpc.bash"));
  CHECK(desk.by_bash("dmpc paint --frame = o") == "oak:");
  CHECK(in_order(desk.by_bash("dmpc paint --frame = oak : ho")) == "hoard.nff hoard.png");
  CHECK(in_order(desk.by_bash("dmpc paint --frame = oak :")) == "hoard.nff hoard.png script stable");
  CHECK(desk.by_bash("dmpc paint --frame = ash : ho").empty());
}

TEST_CASE("bash knows all of dmpc's commands and options") {
  const CommandDescription dmpc = describe_command_line();
  const Desk desk(tests::written(dmpc, "dmpc.bash"));
  for (const char* const path : {"render", "study balance", "bench speed"}) {
    const std::string offered = " " + desk.by_bash("dmpc " + std::string(path) + " -") + " ";
    for (const tests::Leaf& leaf : tests::leaves_of(dmpc)) {
      for (const OptionDescription& option : leaf.command->options) {
        const std::string word = " " + option.names.back() + (option.value.empty() ? " " : "= ");
        CHECK_MESSAGE((leaf.path != path || offered.find(word) != std::string::npos), word);
      }
    }
  }
  CHECK(desk.by_bash("dmpc render tea") == "teapot-12");
  CHECK(desk.by_bash("dmpc render --up = -") == "-x -y -z");  // a value that has a sign
  CHECK(desk.by_bash("dmpc study paper -o ") == "stable");
  CHECK(desk.by_bash("dmpc machine ips") == "ipsc2 ipsc2-1994 ipsc860");
}

}  // namespace dmpc::apps::completion_test
