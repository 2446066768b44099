#include "apps/edge/line/command_description.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace dmpc::apps {

namespace {

/// The words that may stand for a value, from what help shows of it: "SIZE|auto [auto]" is "SIZE" and "auto".
std::vector<std::string> alternatives(const std::string& shown) {
  std::vector<std::string> found;
  std::istringstream words(shown.substr(0, shown.find(" [")));
  for (std::string word; std::getline(words, word, '|');) {
    found.push_back(word.substr(0, word.find_first_of(".,")));
  }
  return found;
}

/// A word that is typed as it stands, perhaps with a sign; names of values have capitals, ranges begin with digits.
bool is_literal(const std::string& word) {
  const std::string unsigned_word = word.substr(word.empty() || word.front() != '-' ? 0 : 1);
  return !unsigned_word.empty() &&
         unsigned_word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos &&
         unsigned_word.front() >= 'a';
}

Suggestion suggestion_for(const std::string& shown, const Suggestions& known) {
  Suggestion all;
  for (const std::string& word : alternatives(shown)) {
    const auto named = known.find(word);
    if (named != known.end()) {
      const Suggestion& more = named->second;
      all.words.insert(all.words.end(), more.words.begin(), more.words.end());
      all.files = all.files || more.files;
      all.folders = all.folders || more.folders;
      all.endings.insert(all.endings.end(), more.endings.begin(), more.endings.end());
    } else if (is_literal(word)) {
      all.words.push_back(word);
    }
  }
  return all;
}

std::vector<std::string> typed_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) {
    names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    names.push_back("--" + name);
  }
  return names;
}

/// A flag stands for "true" unless it was declared with a text.
bool has_optional_value(const CLI::Option& option) {
  const bool is_flag = option.get_items_expected_min() == 0 && !option.get_lnames().empty();
  const std::string name = is_flag ? option.get_lnames().front() : "";
  return is_flag && name != "help" && name != "version" && option.get_flag_value(name, "") != "true";
}

OptionDescription described(const CLI::Option& option, const Suggestions& known) {
  const bool is_argument = option.get_positional();
  const std::string value = is_argument ? option.get_name(true) : option.get_option_text();
  return {.names = typed_names(option),
          .value = value,
          .text = option.get_description(),
          .group = option.get_group(),
          .is_required = option.get_required(),
          .has_optional_value = has_optional_value(option),
          .is_repeatable = option.get_items_expected_max() != 1,
          .is_list = option.get_items_expected_max() > 1 || value.substr(0, value.find(" [")).find(',') != std::string::npos,
          .suggestion = suggestion_for(value, known)};
}

}  // namespace

CommandDescription describe(const CLI::App& app, const Suggestions& known) {
  CommandDescription command{.name = app.get_name(), .text = app.get_description(), .examples = app.get_footer()};
  for (const CLI::Option* const option : app.get_options()) {
    (option->get_positional() ? command.arguments : command.options).push_back(described(*option, known));
  }
  for (const CLI::App* const inner : app.get_subcommands([](const CLI::App*) { return true; })) {
    command.commands.push_back(describe(*inner, known));
  }
  return command;
}

}  // namespace dmpc::apps
