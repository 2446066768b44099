#include "apps/frontend/manual/man_page.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/line/typed_line.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/manual/leaves.h"
#include "apps/frontend/manual/roff.h"

namespace dmpc::apps {

namespace {

constexpr const char* description =
    "dmpc emulates a distributed-memory parallel computer on this machine and renders on it. N nodes, usually one thread each, "
    "with strictly bounded memories of their own, share nothing and communicate only by messages; scenes need not fit into the "
    "memory of any of them. Either pages of the scene's database travel to the nodes whose rays need them, or rays travel to the "
    "nodes that have the part of space through which they pass. Everything that travels is counted, and the picture is the same "
    "to the last bit.";

struct EnvironmentVariable {
  const char* name;
  const char* text;
};

constexpr EnvironmentVariable variables[] = {
    {"TMPDIR", "Folder of temporary files; /tmp if not set."},
    {"NO_COLOR", "Always respected: dmpc never writes in colour. Progress is shown on terminals only."},
};

bool is_help(const OptionDescription& option) { return option.names.back() == "--help"; }

/// " SCENE -o IMAGE [OPTION]...".
std::string usage_of(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& argument : command.arguments) {
    const std::string word = argument.value + (argument.is_list ? "..." : "");
    text += argument.is_required ? " " + word : " [" + word + "]";
  }
  for (const OptionDescription& option : command.options) {
    text += option.is_required ? " " + option.names.front() + " " + value_alone(option) : "";
  }
  return text + " [OPTION]...";
}

/// A line of `examples` that shows a call.
bool is_call(const std::string& line) { return line.rfind("  dmpc ", 0) == 0; }

/// The end of the description of `command` without its calls and the line that announces them: paragraphs, with their line
/// breaks.
std::vector<std::string> remarks_of(const CommandDescription& command) {
  std::vector<std::string> paragraphs(1);
  for (const std::string& line : lines_of(command.examples)) {
    if (line.empty() && !paragraphs.back().empty()) {
      paragraphs.emplace_back();
    }
    paragraphs.back() += line.empty() || is_call(line) || line == "Examples:" ? "" : line + "\n";
  }
  if (paragraphs.back().empty()) {
    paragraphs.pop_back();
  }
  return paragraphs;
}

/// Whether the breaks of lines mean something.
bool is_table(const std::string& paragraph) { return paragraph.find("  ") != std::string::npos; }

/// Without breaks.
std::string filled(const std::string& paragraph) { return joined(lines_of(paragraph), " "); }

/// Writes the page; remembers which options have been explained.
class Writer {
 public:
  Writer(const CommandDescription& program, const std::string& version)
      : program_(program), leaves_(leaves_of(program)), page_("DMPC", version) {}

  std::string page() {
    add_head();
    add_commands();
    add_examples();
    add_rest();
    return page_.text();
  }

 private:
  void add_head() {
    page_.begin_section("NAME");
    page_.add_text("dmpc - " + program_.text.substr(program_.text.find(": ") + 2));
    page_.begin_section("SYNOPSIS");
    for (const Leaf& leaf : leaves_) {
      page_.add_call("dmpc " + leaf.path, usage_of(*leaf.command));
    }
    page_.begin_section("DESCRIPTION");
    page_.add_paragraph(description);
    page_.begin_section("OPTIONS");
    for (const OptionDescription& option : program_.options) {
      add_option(option, "");
    }
    page_.add_paragraph(
        "Every command takes --help, too. A value follows its option as --option=VALUE or as the next word; the default is in "
        "brackets.");
  }

  void add_commands() {
    page_.begin_section("COMMANDS");
    for (const Leaf& leaf : leaves_) {
      page_.begin_part("dmpc " + leaf.path);
      page_.add_paragraph(leaf.command->text + ".");
      add_arguments(*leaf.command);
      add_options(leaf);
      add_remarks(*leaf.command);
    }
  }

  void add_arguments(const CommandDescription& command) {
    for (const OptionDescription& argument : command.arguments) {
      page_.add_entry("", argument.value, argument.text);
    }
  }

  void add_options(const Leaf& leaf) {
    std::vector<std::pair<std::string, std::string>> elsewhere;  ///< a command, and options explained there
    std::string group = leaf.command->options.front().group;
    for (const OptionDescription& option : leaf.command->options) {
      if (is_help(option)) {
        continue;
      }
      const auto known = std::find_if(known_.begin(), known_.end(), [&](const auto& entry) { return entry.first == option; });
      if (known != known_.end()) {
        refer(elsewhere, known->second, option.names.back());
        continue;
      }
      if (option.group != group) {
        page_.add_heading(option.group);
        group = option.group;
      }
      add_option(option, leaf.path);
    }
    for (const auto& [command, options] : elsewhere) {
      page_.add_paragraph("As in dmpc " + command + ": " + options + ".");
    }
  }

  static void refer(std::vector<std::pair<std::string, std::string>>& elsewhere, const std::string& command,
                    const std::string& option) {
    if (elsewhere.empty() || elsewhere.back().first != command) {
      elsewhere.emplace_back(command, option);
    } else {
      elsewhere.back().second += ", " + option;
    }
  }

  void add_option(const OptionDescription& option, const std::string& command) {
    known_.emplace_back(option, command);
    page_.add_entry(joined(option.names, ", "), option.value.empty() ? "" : "=" + option.value, option.text);
  }

  void add_remarks(const CommandDescription& command) {
    for (const std::string& remark : remarks_of(command)) {
      if (is_table(remark)) {
        page_.add_lines(remark);
      } else {
        page_.add_paragraph(filled(remark));
      }
    }
  }

  void add_examples() {
    page_.begin_section("EXAMPLES");
    for (const Leaf& leaf : leaves_) {
      const std::string calls = joined(lines_of(leaf.command->examples), "",
                                       [&](const std::string& line) { return is_call(line) ? line.substr(2) + "\n" : ""; });
      if (!calls.empty()) {
        page_.add_lines(calls);
      }
    }
  }

  void add_rest() {
    page_.begin_section("EXIT STATUS");
    for (const ExitStatus& status : exit_statuses) {
      page_.add_entry(std::to_string(status.status), "", status.meaning);
    }
    page_.begin_section("ENVIRONMENT");
    for (const EnvironmentVariable& variable : variables) {
      page_.add_entry(variable.name, "", variable.text);
    }
    page_.begin_section("SEE ALSO");
    page_.add_paragraph("gnuplot(1), oiiotool(1)");
  }

  const CommandDescription& program_;
  std::vector<Leaf> leaves_;
  ManualPage page_;
  std::vector<std::pair<OptionDescription, std::string>> known_;  ///< an option, and the command that explains it
};

}  // namespace

std::string man_page(const CommandDescription& program, const std::string& version) { return Writer(program, version).page(); }

}  // namespace dmpc::apps
