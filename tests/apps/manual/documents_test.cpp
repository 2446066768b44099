// What documents have the reader type: commands and options that there are.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/manual/leaves.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

Texts words_in(const std::string& text) {
  std::istringstream stream(text);
  Texts words;
  for (std::string word; stream >> word && word != "#" && word != "|" && word != ">";) {
    words.push_back(word);
  }
  return words;
}

/// The words behind "dmpc" or "apps/dmpc" of a line that is a command; nothing of any other.
Texts typed_words(const std::string& line) {
  for (const std::string beginning : {"    dmpc ", "    apps/dmpc "}) {
    if (line.rfind(beginning, 0) == 0) {
      return words_in(line.substr(beginning.size()));
    }
  }
  return {};
}

/// Why the program would not take a line; empty if it does.
std::string complaint_about(const std::string& line) {
  const Texts words = typed_words(line);
  try {
    if (!words.empty()) {
      parse_command_line(words);
    }
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

/// Every option that some command has, "--nodes".
Texts all_options() {
  const CommandDescription program = describe_command_line();
  Texts options = {"--help", "--version"};
  for (const Leaf& leaf : leaves_of(program)) {
    for (const OptionDescription& option : leaf.command->options) {
      options.insert(options.end(), option.names.begin(), option.names.end());
    }
  }
  return options;
}

/// Those of our scripts, of CMake and of what else documents have the reader type.
bool is_foreign(const std::string& option) {
  static const Texts foreign = {"--preset", "--prefix", "--install", "--test-case", "--format",
                                "--tidy",   "--only",   "--seeds",   "--calls",     "--minutes",
                                "--replay", "--shrink", "--keep",    "--clang",     "--benchmark_filter"};
  return std::find(foreign.begin(), foreign.end(), option) != foreign.end();
}

/// Options in `code` of a line that no command has.
Texts unknown_options(const std::string& line) {
  static const Texts known = all_options();
  static const std::regex options(R"([ `(](--[a-z][a-z_-]*))");
  Texts unknown;
  for (auto match = std::sregex_iterator(line.begin(), line.end(), options); match != std::sregex_iterator(); ++match) {
    const std::string option = (*match)[1];
    if (std::find(known.begin(), known.end(), option) == known.end() && !is_foreign(option)) {
      unknown.push_back(option);
    }
  }
  return unknown;
}

/// What is wrong with a line of a document, if anything is.
std::string fault_of(const std::string& line) {
  const Texts unknown = unknown_options(line);
  return unknown.empty() ? complaint_about(line) : "no command has " + unknown.front();
}

std::vector<fs::path> documents() {
  std::vector<fs::path> found;
  for (auto entry = fs::recursive_directory_iterator(DMPC_SOURCE_DIR); entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename();
    if (entry->is_directory() && (name.front() == '.' || name == "build")) {
      entry.disable_recursion_pending();
    } else if (entry->path().extension() == ".md") {
      found.push_back(entry->path());
    }
  }
  return found;
}

/// What examples name exists for a moment only: nothing may depend on what lies in the folder of the tests.
void check_lines(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (const std::string fault = fault_of(line); !fault.empty()) {
      FAIL_CHECK(file.string() << ":" << number << ": " << fault);
    }
  }
}

}  // namespace

TEST_CASE("every command and option in a document is one that dmpc takes") {
  const std::vector<fs::path> files = documents();
  CHECK(files.size() > 10);
  for (const fs::path& file : files) {
    check_lines(file);
  }
}

TEST_CASE("a command or option in a document that dmpc does not take is found") {
  CHECK(fault_of("    dmpc render teapot-12 --nodes=8 -o teapot.png").empty());
  CHECK(fault_of("    dmpc paint teapot-12") != "");
  CHECK(fault_of("    dmpc render teapot-12 --colour=red -o teapot.png") == "no command has --colour");
  CHECK(fault_of("    dmpc study traffic teapot-12 --resume") != "");
  CHECK(fault_of("With `--bogus` nothing is as it was.") == "no command has --bogus");
  CHECK(fault_of("With `--nodes=8` it is, and --strategy=svm; a dash -- is none.").empty());
}

}  // namespace dmpc::apps
