#include "apps/edge/manual/completion.h"
#include "apps/edge/manual/shell_words.h"

namespace dmpc::apps {

namespace {

constexpr const char* fish_head = R"(# Completion of dmpc in fish, written from the declarations of its options.
# Whether the commands typed so far are those given.
function __dmpc_command_is
  set -l path
  for word in (commandline -opc)[2..]
    switch "$path $word"
)";

constexpr const char* fish_engine = R"(        set path (string trim "$path $word")
    end
  end
  test "$path" = "$argv"
end

# The files that have one of these endings, and folders.
function __dmpc_files
  __fish_complete_path (commandline -ct) | string match -rie '(/|\.('(string join '|' $argv)'))(\t|$)'
end

complete -c dmpc -f
)";

std::string fish_quoted(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    escaped += character == '\\' ? "\\\\" : std::string(1, character);
  }
  return quoted(escaped, "\\'");
}

/// "'study balance'" and all others, as the patterns of a `case`.
std::string command_patterns(const CommandDescription& command, const std::string& path) {
  std::string text;
  for (const CommandDescription& inner : command.commands) {
    const std::string inner_path = path + " " + inner.name;
    text += " '" + inner_path + "'" + command_patterns(inner, inner_path);
  }
  return text;
}

/// What may stand for a value. Without `force`, fish offers no files; a list's last word is completed behind its commas.
std::string offers(const Suggestion& suggestion, bool is_list) {
  std::string words = with_blanks(suggestion.words);
  if (is_list && !words.empty()) {
    words = "(__fish_append , " + words + ")";
  }
  if (suggestion.folders) {
    words += std::string(words.empty() ? "" : " ") + "(__fish_complete_directories (commandline -ct))";
  }
  if (!suggestion.endings.empty()) {
    words += std::string(words.empty() ? "" : " ") + "(__dmpc_files " + with_blanks(suggestion.endings) + ")";
  }
  const bool has_all_files = has_colons(suggestion) || (suggestion.files && suggestion.endings.empty());
  return (has_all_files ? " -F" : " -f") + (words.empty() ? "" : " -a " + fish_quoted(words));
}

std::string line_for(const std::string& path, const std::string& rest) {
  return "complete -c dmpc -n " + fish_quoted("__dmpc_command_is " + path) + rest + "\n";
}

std::string option_line(const OptionDescription& option, const std::string& path) {
  std::string names;
  for (const std::string& name : option.names) {
    names += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  const std::string value = option.value.empty() ? "" : " -r" + offers(option.suggestion, option.is_list);
  return line_for(path, names + value + " -d " + fish_quoted(first_line(option.text)));
}

std::string lines(const CommandDescription& command, const std::string& path) {
  std::string text;
  for (const CommandDescription& inner : command.commands) {
    text += line_for(path, " -f -a " + inner.name + " -d " + fish_quoted(inner.text));
  }
  if (!command.arguments.empty()) {
    text += line_for(path, offers(suggestion_of(command.arguments), false));
  }
  for (const OptionDescription& option : command.options) {
    text += option_line(option, path);
  }
  for (const CommandDescription& inner : command.commands) {
    text += lines(inner, path + (path.empty() ? "" : " ") + inner.name);
  }
  return text;
}

}  // namespace

std::string fish_completion(const CommandDescription& program) {
  return fish_head + ("      case" + command_patterns(program, "")) + "\n" + fish_engine + lines(program, "");
}

}  // namespace dmpc::apps
