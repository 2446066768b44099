// The pages of the labs: what they have typed prints what they show.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/documents.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::labs_test {

namespace {

namespace fs = std::filesystem;

/// A command of a page, with what the page shows of its output.
struct Typed {
  std::string command;
  Lines shown;
};

constexpr const char* first_words[] = {"dmpc", "passing_ring", "broadcast", "for"};

/// As apps/labs/lab.py finds them.
bool is_command(const std::string& line) {
  return std::any_of(std::begin(first_words), std::end(first_words),
                     [&line](const char* word) { return line.starts_with("    " + std::string(word) + " "); });
}

std::string trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(' ') + 1 - begin);
}

/// Commands and output are indented by four blanks; lines of a command's that go on end with a backslash. A table stands as it
/// is.
std::vector<Typed> typed_in(const Lines& lines) {
  std::vector<Typed> all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_command(lines[i])) {
      all.push_back({trimmed(lines[i]), {}});
      while (all.back().command.ends_with('\\')) {
        all.back().command.back() = ' ';
        all.back().command += trimmed(lines.at(++i));
      }
    } else if (!all.empty() && (lines[i].starts_with("    ") || lines[i].starts_with("|"))) {
      all.back().shown.push_back(trimmed(lines[i]));
    }
  }
  return all;
}

/// What a shell prints in `folder`, errors too, where our programs are found first.
Lines printed_by(const std::string& command, const fs::path& folder) {
  const std::string path = fs::path(DMPC_PROGRAM).parent_path().string() + ":" + DMPC_EXAMPLES + ":" + std::getenv("PATH");
  const fs::path script = folder / "script", output = folder / "output";
  write_text(script, "cd '" + folder.string() + "'\n" + command + "\n");
  run({"env", "PATH=" + path, "PYTHONPATH=" DMPC_SOURCE_DIR "/apps/python", "sh", "-c",
       "sh '" + script.string() + "' > '" + output.string() + "' 2>&1"});
  Lines lines;
  for (const std::string& line : lines_of(output)) {
    lines.push_back(trimmed(line));
  }
  return lines;
}

/// The first line shown that is not printed behind those before it; empty if there is none.
std::string missing_line(const Lines& shown, const Lines& printed) {
  auto place = printed.begin();
  for (const std::string& line : shown) {
    place = std::find(place, printed.end(), line);
    if (place == printed.end()) {
      return line;
    }
    ++place;
  }
  return "";
}

std::string text_of(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line + "\n";
  }
  return text;
}

void check_page(const std::string& name) {
  const TemporaryFolder folder;
  const std::vector<Typed> all = typed_in(lines_of(fs::path(DMPC_SOURCE_DIR) / "apps/labs" / (name + ".md")));
  CHECK(all.size() > 1);
  CHECK(std::any_of(all.begin(), all.end(), [](const Typed& typed) { return !typed.shown.empty(); }));
  for (const Typed& typed : all) {
    const Lines printed = printed_by(typed.command, folder.path());
    const std::string missing = missing_line(typed.shown, printed);
    CHECK_MESSAGE(missing.empty(), name, ": ", typed.command, "\nshows: ", missing, "\nprints:\n", text_of(printed));
  }
}

}  // namespace

TEST_CASE("the lab of the working set shows what comes of it" * doctest::test_suite("slow")) { check_page("working_set"); }
TEST_CASE("the lab of what should travel shows what comes of it" * doctest::test_suite("slow")) { check_page("travel"); }
TEST_CASE("the lab of granularity shows what comes of it" * doctest::test_suite("slow")) { check_page("granularity"); }
TEST_CASE("the lab of speedup shows what comes of it" * doctest::test_suite("slow")) { check_page("speedup"); }
TEST_CASE("the lab of balance shows what comes of it" * doctest::test_suite("slow")) { check_page("balance"); }
TEST_CASE("the lab of latency shows what comes of it" * doctest::test_suite("slow")) { check_page("latency"); }
TEST_CASE("the lab of deadlock shows what comes of it" * doctest::test_suite("slow")) { check_page("deadlock"); }

TEST_CASE("every lab is in the list of them, and no other") {
  const fs::path folder = fs::path(DMPC_SOURCE_DIR) / "apps/labs";
  const std::string list = text_of(lines_of(folder / "README.md"));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    CHECK_MESSAGE((!name.ends_with(".md") || name == "README.md" || list.find("](" + name + ")") != std::string::npos), name);
  }
}

TEST_CASE("every lab says what it is for, what it takes, and where solutions are") {
  const fs::path folder = fs::path(DMPC_SOURCE_DIR) / "apps/labs";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem(), text = text_of(lines_of(entry.path()));
    if (entry.path().extension() == ".md" && name != "README") {
      for (const std::string& part : Lines{"**You learn** ", "**Before** ", "**Time** ", "**Asked.** ", "**Questions.**",
                                           "](solutions/" + name + ".md)", "](notebooks/" + name + ".ipynb)"}) {
        CHECK_MESSAGE(text.find(part) != std::string::npos, name, ": ", part);
      }
    }
  }
}

TEST_CASE("what a page shows is read with the command that goes before, and a figure that is not printed is found") {
  const std::vector<Typed> all =
      typed_in({"# A lab", "    dmpc info \\", "        teapot-4", "", "| a |", "", "Text.", "    passing_ring", "      line"});
  REQUIRE(all.size() == 1);
  CHECK(all[0].command == "dmpc info  teapot-4");
  CHECK(all[0].shown == Lines{"| a |", "passing_ring", "line"});
  CHECK(missing_line({"a", "c"}, {"a", "b", "c"}).empty());
  CHECK(missing_line({"c", "a"}, {"a", "b", "c"}) == "a");
  CHECK(missing_line({"1.5"}, {"1.6"}) == "1.5");
}

}  // namespace dmpc::tests::labs_test
