#include "apps/edge/line/help_text.h"

#include <algorithm>
#include <vector>

namespace dmpc::apps {

namespace {

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
  std::string text;
  for (const std::string& name : option.names) {
    text += (text.empty() ? "" : ",") + name + (option.standard.empty() ? "" : "{" + option.standard + "}");
  }
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

}  // namespace dmpc::apps
