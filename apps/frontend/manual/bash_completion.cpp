#include "apps/frontend/manual/completion.h"

#include "apps/frontend/line/words.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

constexpr const char* bash_head = R"(# Completion of dmpc in bash, written from the declarations of its options.
# Sets words, files, endings (of files), folders and is_list to what may stand for an argument or, if there is a $2, for the value of this option of
# command $1.
_dmpc_value() {
  words="" files="" endings="" folders="" is_list=""
  case "$1:$2" in
)";

constexpr const char* declarations = R"(  esac
}

# Sets commands, options and valued, the options with a value, to those of command $1.
_dmpc_declared() {
  commands="" options="" valued=""
  case "$1" in
)";

constexpr const char* bash_engine = R"(  esac
}

# Prints the files that go on from $1, with $2 before them: folders, and what has one of the endings set, if any are.
_dmpc_files() {
  compgen -P "$2" -d -- "$1"
  compgen -P "$2" -f -- "$1" | while read -r file; do
    local ending=${file##*.}
    [[ ${ending,,} != gz ]] || ending=${file%.*} ending=${ending##*.}.gz
    [[ -d ${file#"$2"} || " $endings " != *" ${ending,,} "* ]] || echo "$file"
  done
}

# Completes $1 from the words, files and folders set; $2 stands before what bash is to put in place.
_dmpc_offer() {
  local typed=$1 before=$2 last=$1
  if [[ $typed == *:* && " $words " == *" ${typed%%:*}: "* ]]; then  # behind such a word there is a file
    before+=${typed%%:*}:
    [[ $COMP_WORDBREAKS == *:* ]] && before=""
    last=${typed#*:} words="" files=1
  fi
  if [[ -n $is_list ]]; then
    last=${typed##*,}
    before+=${typed%"$last"}
  fi
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$words" -- "$last")
  local found=()
  [[ -n $files && -z $endings ]] && mapfile -t found < <(compgen -P "$before" -f -- "$last")
  [[ -n $files && -n $endings ]] && mapfile -t found < <(_dmpc_files "$last" "$before")
  [[ -n $folders ]] && mapfile -t found < <(compgen -P "$before" -d -- "$last")
  if ((${#found[@]})); then
    COMPREPLY+=("${found[@]}")
    compopt -o filenames 2>/dev/null
  fi
  [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *: ]] && compopt -o nospace 2>/dev/null
  return 0
}

_dmpc() {
  COMPREPLY=()
  local line=() word n
  for ((n = 1; n <= COMP_CWORD; n++)); do  # bash cuts --option=value into three words, and at colons
    word=${COMP_WORDS[n]}
    if ((${#line[@]})) && [[ ($word == = && ${line[-1]} == --*) || (${COMP_WORDS[n - 1]} == = && ${line[-1]} == --*=) ||
      ($word == : && ${line[-1]} == --*=*) || (${COMP_WORDS[n - 1]} == : && ${line[-1]} == --*=*:) ]]; then
      line[-1]+=$word
    else
      line+=("$word")
    fi
  done
  local current=${line[-1]} command="" previous="" commands options valued words files endings folders is_list
  _dmpc_declared ""
  for word in "${line[@]:0:${#line[@]}-1}"; do
    if [[ " $commands " == *" $word "* ]]; then
      command+=${command:+ }$word
      _dmpc_declared "$command"
    fi
    previous=$word
  done
  if [[ $current == --*=* ]]; then
    local before=""
    [[ $COMP_WORDBREAKS == *=* ]] || before=${current%%=*}=
    _dmpc_value "$command" "${current%%=*}"
    _dmpc_offer "${current#*=}" "$before"
  elif [[ -n $previous && " $valued " == *" $previous "* ]]; then
    _dmpc_value "$command" "$previous"
    _dmpc_offer "$current" ""
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2>/dev/null
  elif [[ -n $commands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
  else
    _dmpc_value "$command" ""
    _dmpc_offer "$current" ""
  fi
  return 0
}

complete -F _dmpc dmpc
)";

/// Whatever one of them may be.
Suggestion suggestion_of(const std::vector<OptionDescription>& arguments) {
  Suggestion all;
  for (const OptionDescription& argument : arguments) {
    const Suggestion& one = argument.suggestion;
    all.words.insert(all.words.end(), one.words.begin(), one.words.end());
    all.files = all.files || one.files;
    all.folders = all.folders || one.folders;
    all.endings.insert(all.endings.end(), one.endings.begin(), one.endings.end());
  }
  return all;
}

std::string assignment(const std::string& name, const std::string& value) {
  return value.empty() ? "" : " " + name + "=\"" + value + "\"";
}

std::string value_case(const std::string& pattern, const Suggestion& suggestion, bool is_list) {
  const std::string all = assignment("words", joined(suggestion.words, " ")) + assignment("files", suggestion.files ? "1" : "") +
                          assignment("endings", joined(suggestion.endings, " ")) +
                          assignment("folders", suggestion.folders ? "1" : "");
  return all.empty() ? "" : "    " + pattern + ")" + all + assignment("is_list", is_list ? "1" : "") + " ;;\n";
}

std::string inner_path(const std::string& path, const std::string& name) { return path + (path.empty() ? "" : " ") + name; }

std::string value_cases(const CommandDescription& command, const std::string& path) {
  std::string text = value_case("\"" + path + ":\"", suggestion_of(command.arguments), false);
  for (const OptionDescription& option : command.options) {
    const std::string pattern =
        joined(option.names, " | ", [&](const std::string& name) { return "\"" + path + ":" + name + "\""; });
    text += value_case(pattern, option.suggestion, option.is_list);
  }
  for (const CommandDescription& inner : command.commands) {
    text += value_cases(inner, inner_path(path, inner.name));
  }
  return text;
}

std::string declaration_cases(const CommandDescription& command, const std::string& path) {
  std::vector<std::string> options, valued;
  for (const OptionDescription& option : command.options) {
    for (const std::string& name : option.names) {
      const bool is_long = name.rfind("--", 0) == 0;
      options.push_back(name + (is_long && !option.value.empty() ? "=" : ""));
      if (!option.value.empty()) {
        valued.push_back(name);
      }
    }
  }
  const std::vector<std::string> commands = core::mapped<std::string>(command.commands, &CommandDescription::name);
  std::string text = "    \"" + path + "\")" + assignment("commands", joined(commands, " ")) +
                     assignment("options", joined(options, " ")) + assignment("valued", joined(valued, " ")) + " ;;\n";
  for (const CommandDescription& inner : command.commands) {
    text += declaration_cases(inner, inner_path(path, inner.name));
  }
  return text;
}

}  // namespace

std::string bash_completion(const CommandDescription& program) {
  return bash_head + value_cases(program, "") + declarations + declaration_cases(program, "") + bash_engine;
}

}  // namespace dmpc::apps
