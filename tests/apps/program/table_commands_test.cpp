// What all commands that print tables have in common, by their command lines.
#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/lab/bench/precision/command.h"
#include "apps/lab/bench/speed/command.h"
#include "apps/lab/bench/stability/command.h"
#include "apps/lab/study/cache.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/unwritable.h"

namespace dmpc::tests::table_commands_test {
namespace {

using Words = std::vector<std::string>;

int run_by(const Words& words, const apps::Command& command, apps::Interrupt& interrupt, std::ostream& output) {
  if (words[1] == "speed") {  // which calls dmpc itself: another one than the test's
    auto options = command.options<apps::SpeedOptions>();
    options.settings.program = DMPC_PROGRAM;
    return apps::bench_speed_command(options, interrupt, output);
  }
  return command.run(interrupt, output);
}

struct TableRun {
  int status = 0;
  std::string output;
};

TableRun run_table(Words words, const Words& more = {}) {
  words.insert(words.end(), more.begin(), more.end());
  apps::Interrupt interrupt;
  std::ostringstream output;
  const int status = run_by(words, apps::parse_command_line(words), interrupt, output);
  return {status, output.str()};
}

/// A command that takes but a moment, with what it has beside its table.
struct TableCase {
  Words words;
  std::string data_file = {};  ///< in the folder of its pictures, if it draws any
  bool has_page = false;
  bool takes_files = true;  ///< as scenes
};

std::vector<TableCase> table_cases() {
  return {{{"study", "cache", "balls-1", "--resolution=8x8", "--nodes=2"}, "cache.csv", true},
          {{"bench", "speed", "tetra-1", "--quick", "--parts=kernel", "--repeat=1", "--threads=1"}},
          {{"bench", "stability", "--tests=R5", "--rays=20"}, "", false, false},
          {{"bench", "precision", "tetra-1", "--resolution=8x8"}}};
}

}  // namespace

TEST_CASE("a picture or page that cannot be written keeps no command's table, and the status is 1") {
  for (const TableCase& one : table_cases()) {
    const TemporaryFolder folder;
    CAPTURE(one.words[1]);
    Words outputs = {"-o", folder / "table.md"};
    if (!one.data_file.empty()) {
      make_unwritable(folder / "plots" / one.data_file);
      outputs.push_back("--plots=" + (folder / "plots").string());
    }
    if (one.has_page) {
      make_unwritable(folder / "page.html");
      outputs.push_back("--report=" + (folder / "page.html").string());
    }
    CHECK(run_table(one.words, outputs).status == (one.data_file.empty() ? 0 : 1));
    CHECK(file_text(folder / "table.md").starts_with("**"));
  }
}

TEST_CASE("every table, with its title and notes, fits lines of 120 letters") {
  for (const TableCase& one : table_cases()) {
    const TemporaryFolder folder;
    CAPTURE(one.words[1]);
    CHECK(widest_line(run_table(one.words).output) <= 120);
  }
}

TEST_CASE("a table that cannot be written keeps none of its pictures") {
  const TemporaryFolder folder;
  make_unwritable(folder / "table.md");
  const Words outputs = {"-o", folder / "table.md", "--plots", folder / "plots", "--report", folder / "page.html"};
  CHECK(run_table(table_cases()[0].words, outputs).status == 1);
  CHECK(std::filesystem::exists(folder / "plots" / "cache.csv"));
  CHECK(contains(file_text(folder / "page.html"), "</html>"));
}

TEST_CASE("what is in the way of any output is said before a command begins") {
  for (const TableCase& one : table_cases()) {
    const TemporaryFolder folder;
    CAPTURE(one.words[1]);
    std::filesystem::create_directories(folder / "table.md");
    CHECK_THROWS_AS(run_table(one.words, {"-o", folder / "table.md"}), core::InputError);
    if (!one.data_file.empty()) {
      std::filesystem::create_directories(folder / "plots" / one.data_file);
      CHECK_THROWS_AS(run_table(one.words, {"--plots", folder / "plots", "-o", folder / "a.md"}), core::InputError);
      CHECK_FALSE(std::filesystem::exists(folder / "a.md"));
    }
  }
}

TEST_CASE("no command's output replaces a file that its scene is read from") {
  for (const TableCase& one : table_cases()) {
    if (!one.takes_files) {
      continue;
    }
    const TemporaryFolder folder;
    CAPTURE(one.words[1]);
    const std::string obj = folder / "a.obj", mtl = folder / "a.mtl", material = "newmtl m\nKd 1 0 0\n";
    write_text(obj, "mtllib a.mtl\nusemtl m\n" + triangle_obj);
    write_text(mtl, material);
    Words words = one.words;
    words[2] = obj;
    CHECK_THROWS_AS(run_table(words, {"-o", obj}), core::UsageError);
    CHECK_THROWS_AS(run_table(words, {"-o", mtl}), core::UsageError);
    CHECK(file_text(mtl) == material);
    if (!one.data_file.empty()) {
      std::filesystem::create_directory(folder / "plots");
      std::filesystem::create_hard_link(obj, folder / "plots" / one.data_file);
      CHECK_THROWS_AS(run_table(words, {"--plots", folder / "plots", "-o", folder / "b.md"}), core::UsageError);
    }
  }
}

}  // namespace dmpc::tests::table_commands_test
