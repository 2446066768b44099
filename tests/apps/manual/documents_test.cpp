// What documents have the reader type: commands and options that there are.

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/apps/manual/leaves.h"
#include "tests/support/complaint.h"
#include "tests/support/documents.h"

namespace dmpc::apps::manual_documents_test {

namespace {

using Texts = std::vector<std::string>;

Texts words_in(const std::string& text) {
  std::istringstream stream(text);
  Texts words;
  for (std::string word; stream >> word && word != "#" && word != "|" && word != ">";) {
    words.push_back(word);
  }
  return words;
}

/// With those that follow it, as far as each ends with a backslash.
std::string whole_line(const Texts& lines, std::size_t index) {
  std::string line = lines[index];
  while (line.ends_with('\\') && ++index < lines.size()) {
    line.back() = ' ';
    line += lines[index];
  }
  return line;
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
  Texts words = typed_words(line);
  if (words.size() > 1 && words[1].ends_with(".pages")) {
    words[1] = "teapot-12";  // for the scene that such a file, which is not here, was built from
  }
  return words.empty() ? "" : tests::complaint_of<core::UsageError>([&] { parse_command_line(words); });
}

/// Every option that some command has, "--nodes".
Texts all_options() {
  const CommandDescription program = describe_command_line();
  Texts options = {"--help", "--version"};
  for (const tests::Leaf& leaf : tests::leaves_of(program)) {
    for (const OptionDescription& option : leaf.command->options) {
      options.insert(options.end(), option.names.begin(), option.names.end());
    }
  }
  return options;
}

/// Whether it is an option of our scripts, of CMake or of another program in the documents.
bool is_foreign(const std::string& option) {
  static const Texts foreign = {"--preset",   "--prefix", "--install", "--component", "--build",         "--test-case",
                                "--format",   "--tidy",   "--only",    "--seeds",     "--calls",         "--minutes",
                                "--replay",   "--shrink", "--keep",    "--clang",     "--mpi",           "--lanes",
                                "--places",   "--faults", "--mca",     "--program",   "--mpirun",        "--heat",
                                "--size",     "--all",    "--part",    "--excerpts",  "--oversubscribe", "--allow-run-as-root",
                                "--children", "--pieces", "--bytes",   "--check"};
  return std::find(foreign.begin(), foreign.end(), option) != foreign.end();
}

/// Options in `code` of a line that no command has.
Texts unknown_options(const std::string& line) {
  static const Texts known = all_options();
  static const std::regex options(R"([ `(](--[a-z][a-z_-]*))");
  Texts unknown;
  for (const std::string& option : tests::found_in(line, options)) {
    if (std::find(known.begin(), known.end(), option) == known.end() && !is_foreign(option)) {
      unknown.push_back(option);
    }
  }
  return unknown;
}

const CommandDescription* find_command(const CommandDescription& outer, const std::string& name) {
  const auto found = std::find_if(outer.commands.begin(), outer.commands.end(),
                                  [&](const CommandDescription& command) { return command.name == name; });
  return found == outer.commands.end() ? nullptr : &*found;
}

bool has_option(const CommandDescription& command, const std::string& option) {
  return std::any_of(command.options.begin(), command.options.end(), [&](const OptionDescription& each) {
    return std::find(each.names.begin(), each.names.end(), option) != each.names.end();
  });
}

/// What is wrong with `dmpc study balance --nodes=8` within a text, which may leave out what a command must have. In capitals
/// words stand for any others.
std::string complaint_about_quoted(const std::string& typed) {
  static const CommandDescription program = describe_command_line();
  const CommandDescription* command = &program;
  for (const std::string& word : words_in(typed)) {
    const CommandDescription* const inner = find_command(*command, word);
    const bool is_option = word.rfind("--", 0) == 0;
    const bool is_for_any = std::isupper(static_cast<unsigned char>(word.front())) != 0;
    if (is_option ? !has_option(*command, word.substr(0, word.find('=')))
                  : inner == nullptr && !command->commands.empty() && !is_for_any) {
      return "there is no dmpc " + typed;
    }
    command = inner != nullptr ? inner : command;
  }
  return "";
}

/// What is wrong with commands within a line's text, in `code`.
std::string complaint_about_text(const std::string& line) {
  static const std::regex quoted(R"(`dmpc ([a-z][^`]*))");
  std::string complaint;
  for (const std::string& typed : tests::found_in(line, quoted)) {
    complaint += complaint_about_quoted(typed);
  }
  return complaint;
}

/// What is wrong with a line of a document, if anything is.
std::string fault_of(const std::string& line) {
  const Texts unknown = unknown_options(line);
  return unknown.empty() ? complaint_about(line) + complaint_about_text(line) : "no command has " + unknown.front();
}

}  // namespace

TEST_CASE("every command and option in a document is one that dmpc takes") {
  for (const tests::Document& document : tests::all_documents(DMPC_SOURCE_DIR)) {
    for (std::size_t i = 0; i < document.lines.size(); ++i) {
      const std::string fault = fault_of(whole_line(document.lines, i));
      CHECK_MESSAGE(fault.empty(), document.path.string(), ":", i + 1, ": ", fault);
    }
  }
}

TEST_CASE("a command or option in a document that dmpc does not take is found") {
  CHECK(fault_of("    dmpc render teapot-12 --nodes=8 -o teapot.png").empty());
  CHECK(fault_of("    dmpc paint teapot-12") != "");
  CHECK(whole_line({"    dmpc info a \\", "        --nodes=8 \\", "    --bogus", "x"}, 0) ==
        "    dmpc info a          --nodes=8      --bogus");
  CHECK(fault_of("    dmpc render teapot-12 --colour=red -o teapot.png") == "no command has --colour");
  CHECK(fault_of("    dmpc study traffic teapot-12 --resume") != "");
  CHECK(fault_of("With `--bogus` nothing is as it was.") == "no command has --bogus");
  CHECK(fault_of("See `dmpc COMMAND --help`, `dmpc machine NAME`.").empty());
  CHECK(fault_of("See `dmpc study balance --nodes=8`.").empty());
  CHECK(fault_of("See `dmpc study balance --resume`.") == "there is no dmpc study balance --resume");
  CHECK(fault_of("See `dmpc study jugglery`.") == "there is no dmpc study jugglery");
  CHECK(fault_of("See `dmpc jugglery`.") == "there is no dmpc jugglery");
  CHECK(fault_of("With `--nodes=8` it is, and --strategy=svm; a dash -- is none.").empty());
}

}  // namespace dmpc::apps::manual_documents_test
