#include "apps/frontend/line/help_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <vector>

#include "apps/frontend/line/folded_text.h"
#include "apps/frontend/line/words.h"

namespace dmpc::apps {
namespace {

/// Below this there is too little room beside names.
constexpr std::size_t explanation_min = 36;
constexpr std::size_t narrow_indent = 8;

/// Letters in a line of the terminal that the standard output is; 0 if it is none, or does not say.
std::size_t terminal_width() {
  winsize size{};
  return ::isatty(STDOUT_FILENO) == 1 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool is_explanation(const std::string& line) {
  return line.size() > help_column && line.starts_with("  ") && line[help_column - 1] == ' ' && line[help_column] != ' ';
}

std::string with_indent(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream lines(folded(text, width > indent ? width - indent : 1, ""));
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    result += (result.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
  }
  return result;
}

std::string fitted_explanation(const std::string& line, std::size_t width) {
  const std::string names = line.substr(0, help_column), text = line.substr(help_column);
  if (width >= help_column + explanation_min) {
    return names + with_indent(text, width, help_column);
  }
  const std::size_t end = names.find_last_not_of(' ');
  const std::string above = end == std::string::npos ? "" : names.substr(0, end + 1) + "\n";
  return above + std::string(narrow_indent, ' ') + with_indent(text, width, narrow_indent);
}

/// A name, and beside it, or below where it is long, what it means.
std::string explained(const std::string& name, const std::string& text) {
  std::string line = "  " + name;
  if (line.size() >= help_column && !text.empty()) {
    line += "\n";
  }
  const std::size_t start = line.rfind('\n') == std::string::npos ? 0 : line.rfind('\n') + 1;
  line.resize(std::max(line.size(), start + help_column), ' ');
  for (const char c : text) {
    line += c;
    line.append(c == '\n' ? help_column : 0, ' ');
  }
  return line + "\n";
}

std::string names_and_value(const OptionDescription& option) {
  const std::string text = joined(option.names, ",", [&](const std::string& name) {
    return name + (option.standard.empty() ? "" : "{" + option.standard + "}");
  });
  return text + (option.value.empty() ? "" : " " + option.value);
}

std::string usage_line(const CommandDescription& command, const std::string& path) {
  std::string text = "Usage: " + path + " [options]";
  for (const OptionDescription& argument : command.arguments) {
    const std::string name = argument.value + (argument.is_list ? "..." : "");
    text += " " + (argument.is_required ? name : "[" + name + "]");
  }
  return text + (command.commands.empty() ? "" : " COMMAND") + "\n";
}

std::vector<std::string> groups_of(const std::vector<OptionDescription>& options) {
  std::vector<std::string> groups;
  for (const OptionDescription& option : options) {
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) {
      groups.push_back(option.group);
    }
  }
  return groups;
}

}  // namespace

std::string fitted_help(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const bool fits = line.size() <= width || (line.starts_with(' ') && !is_explanation(line));
    result += (fits ? line : is_explanation(line) ? fitted_explanation(line, width) : with_indent(line, width, 0)) + "\n";
  }
  return result;
}

void print_help(std::ostream& output, const std::string& text) {
  const std::size_t width = &output == &std::cout ? terminal_width() : 0;
  output << (width > 0 ? fitted_help(text, width) : text);
}

std::string help_text(const CommandDescription& command, const std::string& path) {
  std::string text = (command.text.empty() ? "" : command.text + "\n") + usage_line(command, path);
  text += command.arguments.empty() ? "" : "\nArguments:\n";
  for (const OptionDescription& argument : command.arguments) {
    text += explained(argument.value, argument.text);
  }
  const std::vector<std::string> groups = groups_of(command.options);
  for (const std::string& group : groups) {
    text += (group == groups.front() ? "\n" : "\n\n") + group + ":\n";
    for (const OptionDescription& option : command.options) {
      text += option.group == group ? explained(names_and_value(option), option.text) : "";
    }
  }
  text += command.commands.empty() ? "" : "\nCommands:\n";
  for (const CommandDescription& inner : command.commands) {
    text += explained(inner.name, inner.text);
  }
  return text + "\n" + (command.examples.empty() ? "" : command.examples + "\n");
}

std::string brief_help_text(const CommandDescription& command, const std::string& path) {
  if (command.brief.empty()) {
    return help_text(command, path);
  }
  std::string text = command.text + "\n" + usage_line(command, path);
  for (const BriefGroup& group : command.brief) {
    text += "\n" + group.title + ":\n";
    for (const auto& [name, meaning] : group.rows) {
      text += explained(name, meaning);
    }
  }
  return text + "\n" + path + " --help=all shows all " + std::to_string(command.options.size()) +
         " options and examples, dmpc help WORD explains a word.\n";
}

}  // namespace dmpc::apps
