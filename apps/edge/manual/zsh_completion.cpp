#include "apps/edge/manual/completion.h"
#include "apps/edge/manual/shell_words.h"

namespace dmpc::apps {

namespace {

constexpr const char* zsh_head = "#compdef dmpc\n# Completion of dmpc in zsh, written from the declarations of its options.\n";

/// For _arguments and _describe, between single quotation marks: what means something to them stands for itself.
std::string plain(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    escaped += (std::string("[]:\\").find(character) == std::string::npos ? "" : "\\") + std::string(1, character);
  }
  return escaped;
}

std::string function_of(const std::string& path) {
  std::string name = "_dmpc";
  for (const char character : path) {
    name += character == ' ' ? '_' : character;
  }
  return name;
}

/// What offers files, or folders, between double quotation marks; empty for neither.
std::string files_action(const Suggestion& suggestion) {
  std::string endings;
  for (const std::string& ending : suggestion.endings) {
    endings += (endings.empty() ? "" : "|") + ending;
  }
  const std::string pattern = endings.empty() ? "" : " -g \\\"*.(#i)(" + endings + ")\\\"";
  return suggestion.files ? "_files" + pattern : suggestion.folders ? "_files -/" : "";
}

/// The action of _arguments that offers a value.
std::string action(const Suggestion& suggestion, bool is_list) {
  const std::string words = with_blanks(suggestion.words);
  if (has_colons(suggestion)) {
    return "{compset -P '*:' && _files || compadd -S '' - " + words + "}";
  }
  const std::string files = files_action(suggestion);
  if (words.empty()) {
    return files.empty() ? " " : files;
  }
  if (!files.empty()) {
    return "{_alternative \"words:word:(" + words + ")\" \"files:file:" + files + "\"}";
  }
  return is_list ? "{_sequence compadd - " + words + "}" : "(" + words + ")";
}

/// What help calls a value, without its default and without what it may be.
std::string message(const OptionDescription& option) {
  const std::string name = option.value.substr(0, option.value.find(" ["));
  return option.suggestion.words.empty() ? plain(name) : "value";
}

std::string specifications(const OptionDescription& option) {
  const std::string exclusion = option.names.size() > 1 ? "(" + with_blanks(option.names) + ")" : "";
  std::string text;
  for (const std::string& name : option.names) {
    const char* const assigned = option.value.empty() ? "" : name.rfind("--", 0) == 0 ? "=" : "+";
    const std::string value = option.value.empty() ? "" : ":" + message(option) + ":" + action(option.suggestion, option.is_list);
    text += " \\\n    " + quoted(exclusion + name + assigned + "[" + plain(first_line(option.text)) + "]" + value, "'\\''");
  }
  return text;
}

std::string specifications(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& option : command.options) {
    text += specifications(option);
  }
  for (const OptionDescription& argument : command.arguments) {
    const char* const repeated = argument.is_list ? "*" : "";
    text += " \\\n    " + quoted(repeated + (":" + plain(argument.value)) + ":" + action(argument.suggestion, false), "'\\''");
  }
  return text;
}

/// The function that completes what follows a command, and those of its commands.
std::string functions(const CommandDescription& command, const std::string& path) {
  if (command.commands.empty()) {
    return "\n" + function_of(path) + "() {\n  _arguments" + specifications(command) + "\n}\n";
  }
  std::string described, cases, inner;
  for (const CommandDescription& one : command.commands) {
    const std::string inner_path = path + " " + one.name;
    described += " " + quoted(one.name + ":" + plain(one.text), "'\\''");
    cases += "    " + one.name + ") " + function_of(inner_path) + " ;;\n";
    inner += functions(one, inner_path);
  }
  return inner + "\n" + function_of(path) + "() {\n  local state line curcontext=$curcontext commands=(" + described +
         ")\n  _arguments -C" + specifications(command) + " \\\n    '1: :->command' '*:: :->rest' && return\n" +
         "  if [[ $state == command ]]; then\n    _describe command commands\n    return\n  fi\n  case $words[1] in\n" + cases +
         "  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandDescription& program) { return zsh_head + functions(program, "") + "\n_dmpc \"$@\"\n"; }

}  // namespace dmpc::apps
