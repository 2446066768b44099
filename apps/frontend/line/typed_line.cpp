#include "apps/frontend/line/typed_line.h"

#include <algorithm>
#include <map>
#include <optional>

#include "apps/frontend/line/unknown_option.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using core::UsageError;

bool is_long(const std::string& word) { return word.size() > 2 && word.starts_with("--"); }
/// "-" alone is an argument.
bool is_short(const std::string& word) { return word.size() > 1 && word.front() == '-' && word[1] != '-'; }

std::string long_name(const OptionDescription& option) { return option.names.back(); }
bool is_flag(const OptionDescription& option) { return option.value.empty(); }

const OptionDescription* find_option(const CommandDescription& command, const std::string& name) {
  for (const OptionDescription& option : command.options) {
    if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) {
      return &option;
    }
  }
  return nullptr;
}

std::vector<std::string> long_names(const CommandDescription& command) {
  return core::mapped<std::string>(command.options, [&](const OptionDescription& option) { return long_name(option); });
}

std::vector<std::string> command_names(const CommandDescription& command) {
  return core::mapped<std::string>(command.commands, &CommandDescription::name);
}

/// Two commands, one in the other.
std::string nested(const std::string& outer, const std::string& inner) {
  return outer + (outer.empty() || inner.empty() ? "" : " ") + inner;
}

/// The first command within `outer` that has the option; empty if none has.
std::string command_with(const CommandDescription& outer, const std::string& option, const std::string& path = "") {
  for (const CommandDescription& inner : outer.commands) {
    const std::string inner_path = nested(path, inner.name);
    if (find_option(inner, option) != nullptr) {
      return inner_path;
    }
    if (const std::string found = command_with(inner, option, inner_path); !found.empty()) {
      return found;
    }
  }
  return "";
}

std::string usage_of(const std::string& path, const CommandDescription& command) {
  std::string text = path + joined(command.arguments, "", [&](const OptionDescription& argument) {
                       return " " + argument.value + (argument.is_list ? "..." : "");
                     });
  for (const OptionDescription& option : command.options) {
    text += option.is_required ? " " + option.names.front() + " " + value_alone(option) : "";
  }
  return text;
}

/// Takes a line apart from left to right.
class Reader {
 public:
  Reader(const CommandDescription& program, std::span<const std::string> rest)
      : program_(program), here_(&program), rest_(rest) {}

  TypedLine read() {
    if (asks_for_help()) {
      line_.asks_for_help = true;
      return line_;
    }
    for (read_command(); !rest_.empty() && !line_.asks_for_version;) {
      read_word();
    }
    if (!line_.asks_for_version) {
      check_whole();
      line_.words.emplace_back("--");
      line_.words.insert(line_.words.end(), arguments_.begin(), arguments_.end());
    }
    return line_;
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw UsageError(sentence + hint_at_help(line_.command, program_.name));
  }

  std::string take() {
    const std::string word = rest_.front();
    rest_ = rest_.subspan(1);
    return word;
  }

  /// Help is given about as many commands as are understood, whatever else is wrong.
  bool asks_for_help() {
    const auto end = std::find(rest_.begin(), rest_.end(), "--");
    line_.asks_for_all_help = std::find(rest_.begin(), end, "--help=all") != end;
    if (!line_.asks_for_all_help &&
        std::find_if(rest_.begin(), end, [](const std::string& word) { return word == "--help" || word == "-h"; }) == end) {
      return false;
    }
    while (!rest_.empty() && enter(rest_.front())) {
      take();
    }
    return rest_.empty() || here_->commands.empty() || rest_.front().starts_with("-") || (fail_on_command(rest_.front()), false);
  }

  /// Whether there is such a command where we are, in which we are then.
  bool enter(const std::string& name) {
    for (const CommandDescription& inner : here_->commands) {
      if (inner.name == name) {
        here_ = &inner;
        line_.command = nested(line_.command, name);
        line_.words.push_back(name);
        return true;
      }
    }
    return false;
  }

  void read_command() {
    while (!here_->commands.empty() && !(!rest_.empty() && rest_.front().starts_with("-"))) {
      if (rest_.empty()) {
        fail("a command is missing: expected " + nested(program_.name, line_.command) + " " + listed(command_names(*here_)));
      }
      if (!enter(rest_.front())) {
        fail_on_command(rest_.front());
      }
      take();
    }
  }

  /// Never returns.
  void fail_on_command(const std::string& word) const {
    if (const std::string instead = said_instead_of(line_.command + " " + word); !instead.empty()) {
      fail("dmpc " + line_.command + " " + word + " is no command any more: " + instead);
    }
    const std::vector<std::string> names = command_names(*here_);
    std::string advice = core::did_you_mean(word, names);
    for (const CommandDescription& inner : program_.commands) {
      const std::vector<std::string> inner_names = command_names(inner);
      if (advice.empty() && std::find(inner_names.begin(), inner_names.end(), word) != inner_names.end()) {
        advice = " Did you mean " + inner.name + " " + word + "?";
      }
    }
    fail((word.empty() ? "an empty word" : word) + " is no command: expected " + listed(names) + (advice.empty() ? "" : ".") +
         advice);
  }

  void read_word() {
    const std::string word = take();
    if (word == "--") {
      while (!rest_.empty()) {
        add_argument(take());
      }
    } else if (is_long(word)) {
      read_long(word);
    } else if (is_short(word)) {
      read_short(word);
    } else {
      add_argument(word);
    }
  }

  void read_long(const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const OptionDescription* const option = find_option(*here_, name);
    if (option == nullptr) {
      fail_on_option(name);
    }
    add(*option, name, equals == std::string::npos ? std::nullopt : std::optional(word.substr(equals + 1)), word);
  }

  void read_short(const std::string& word) {
    const std::string name = word.substr(0, 2);
    const OptionDescription* const option = find_option(*here_, name);
    if (option == nullptr) {
      fail_on_option(word.substr(0, word.find('=')));
    }
    if (word.size() == 2) {
      return add(*option, name, std::nullopt, word);
    }
    const bool is_long_meant =
        word.size() > 3 && core::edit_distance(word.substr(0, word.find('=')), long_name(*option).substr(1)) <= 1;
    if (word[2] == '=' || is_flag(*option) || is_long_meant) {
      fail(word + ": expected " + typed_form(*option));
    }
    add(*option, name, word.substr(2), word);
  }

  [[noreturn]] void fail_on_option(const std::string& name) const {
    const std::string said = name + " is no option" + (line_.command.empty() ? "" : " of dmpc " + line_.command);
    const std::string full = is_long(name) ? name : "-" + name;
    if (find_option(*here_, full) != nullptr) {
      fail(said + ". Did you mean " + full + "?");
    }
    for (const std::string& gone : {full, line_.command + " " + full}) {
      if (const std::string instead = said_instead_of(gone); !instead.empty()) {
        fail(said + " any more: " + instead);
      }
    }
    fail_if_foreign(name, said);
    const bool has_command = here_->commands.empty();
    const std::string other = has_command ? command_with(program_, full) : command_with(*here_, full, line_.command);
    if (!other.empty()) {
      fail(said + (has_command ? ", but of dmpc " + other : ": options follow their command, as in dmpc " + other + " " + full));
    }
    fail(said + "." + core::did_you_mean(full, long_names(*here_)));
  }

  /// Fails if other programs have such an option, and this command what it stands for.
  void fail_if_foreign(const std::string& name, const std::string& said) const {
    const std::optional<ForeignOption> foreign = foreign_option(name);
    const OptionDescription* const ours = foreign ? find_option(*here_, foreign->ours) : nullptr;
    if (ours != nullptr) {
      fail(said + ": expected " + typed_form(*ours) + ", " + foreign->note);
    }
  }

  /// What an option is to have and has not.
  [[noreturn]] void fail_without_value(const OptionDescription& option, const std::string& word, const std::string& why) const {
    fail(word + ": a value is missing" + why + "; expected " + typed_form(option));
  }

  void add(const OptionDescription& option, const std::string& name, std::optional<std::string> value, const std::string& word) {
    if (name == "--version") {
      line_.asks_for_version = true;
    }
    if (is_flag(option) && !option.has_optional_value && value) {
      fail(word + ": " + name + " takes no value; give " + name + " alone, or leave it out");
    }
    if (!is_flag(option) && !value) {
      value = next_value(option, word);
    }
    if (value && value->empty()) {
      fail_without_value(option, word, "");
    }
    note_once(option, name, value.value_or(""));
    line_.words.push_back(long_name(option) + (value ? "=" + *value : ""));
  }

  std::string next_value(const OptionDescription& option, const std::string& word) {
    if (rest_.empty()) {
      fail_without_value(option, word, "");
    }
    const std::string& next = rest_.front();
    if ((is_long(next) || is_short(next)) && find_option(*here_, next.substr(0, is_long(next) ? next.find('=') : 2)) != nullptr) {
      fail_without_value(option, word, ", and " + next + " is an option");
    }
    return take();
  }

  void note_once(const OptionDescription& option, const std::string& name, const std::string& value) {
    const auto [before, is_first] = given_.try_emplace(long_name(option), value);
    if (!is_first && !is_flag(option) && !option.is_repeatable) {
      fail(name + " is given twice, as " + before->second + " and as " + value + ": give it once");
    }
  }

  void add_argument(const std::string& word) {
    const bool takes_all = !here_->arguments.empty() && here_->arguments.back().is_list;
    if (!takes_all && arguments_.size() >= here_->arguments.size()) {
      fail_on_argument(word);
    }
    if (word.empty()) {
      fail(here_->arguments[std::min(arguments_.size(), here_->arguments.size() - 1)].value + " is empty: expected " +
           usage_of(nested(program_.name, line_.command), *here_));
    }
    arguments_.push_back(word);
  }

  /// One too many; perhaps an option without its dashes, perhaps the rest of a name with a blank.
  [[noreturn]] void fail_on_argument(const std::string& word) const {
    const std::string name = "--" + word.substr(0, word.find('='));
    if (word.find('=') != std::string::npos && find_option(*here_, name) != nullptr) {
      fail(word + " is an argument too many. Did you mean --" + word + "?");
    }
    if (word.starts_with("+")) {
      fail_if_foreign(word, word + " is no option");
    }
    if (here_->commands.empty()) {
      fail("'" + word + "' is an argument too many: expected " + usage_of(nested(program_.name, line_.command), *here_) +
           "; a name with blanks stands between quotation marks");
    }
    fail_on_command_first(word);
  }

  [[noreturn]] void fail_on_command_first(const std::string& word) const {
    fail("'" + word + "' follows an option: the command comes first, as in dmpc " + nested(line_.command, word));
  }

  void check_whole() const {
    if (!here_->commands.empty()) {
      fail("a command is missing: expected " + nested(program_.name, line_.command) + " " + listed(command_names(*here_)));
    }
    for (std::size_t i = 0; i < here_->arguments.size(); ++i) {
      if (here_->arguments[i].is_required && i >= arguments_.size()) {
        fail(here_->arguments[i].value + " is missing: expected " + usage_of(nested(program_.name, line_.command), *here_));
      }
    }
    for (const OptionDescription& option : here_->options) {
      if (option.is_required && !given_.contains(long_name(option))) {
        fail(option.names.front() + " is missing: expected " + usage_of(nested(program_.name, line_.command), *here_));
      }
    }
  }

  const CommandDescription& program_;
  const CommandDescription* here_;  ///< the command read so far
  std::span<const std::string> rest_;
  TypedLine line_;
  std::vector<std::string> arguments_;
  std::map<std::string, std::string> given_;  ///< by long name the first value
};

}  // namespace

std::string hint_at_help(const std::string& command, const std::string& program) {
  return "\nTry: " + nested(nested(program, command), "--help");
}

std::string value_alone(const OptionDescription& option) { return option.value.substr(0, option.value.find(" [")); }

std::string typed_form(const OptionDescription& option) {
  const std::string value = value_alone(option);
  if (option.names.front().starts_with("--")) {
    return option.names.front() + (value.empty() ? "" : "=" + value);
  }
  return option.names.front() + (value.empty() ? "" : " " + value) + " or " + option.names.back() +
         (value.empty() ? "" : "=" + value);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  return text;
}

TypedLine read_line(const CommandDescription& program, std::span<const std::string> arguments) {
  return Reader(program, arguments).read();
}

}  // namespace dmpc::apps
