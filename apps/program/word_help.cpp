#include "apps/program/word_help.h"

#include <algorithm>

#include "apps/frontend/help/glossary.h"
#include "apps/frontend/line/folded_text.h"
#include "apps/frontend/line/small_letters.h"
#include "apps/help/choices.h"

namespace dmpc::apps {

namespace {

constexpr std::size_t line_letters_max = 100;

/// "pages" for "page", too, and "page wait" for "wait".
bool is_called(std::string_view word, std::string_view name) {
  return word == name || word.ends_with(" " + std::string(name)) ||
         (word.ends_with('s') && word.substr(0, word.size() - 1) == name);
}

std::string paragraph(const std::string& name, std::string_view meaning) {
  return folded(name + ": " + std::string(meaning), line_letters_max, "  ") + "\n";
}

std::string from_glossary(std::string_view word) {
  for (const GlossaryEntry& entry : glossary()) {
    if (is_called(word, entry.word)) {
      return paragraph(std::string(entry.word), entry.meaning);
    }
  }
  return "";
}

std::string from_choices(std::string_view word) {
  std::string text;
  for (const ChoiceList& list : all_choices()) {
    for (const Choice& choice : list.entries) {
      const std::string where = list.where + (list.where.ends_with('=') ? choice.name : "");
      text += choice.name == word ? paragraph(choice.name + " (" + where + ")", choice.meaning) : "";
    }
  }
  return text;
}

/// Of the first command that has it, within `command`; `path` names that.
std::string from_options(std::string_view word, const CommandDescription& command, const std::string& path) {
  const std::string name = "--" + std::string(word.substr(std::min(word.find_first_not_of('-'), word.size())));
  for (const OptionDescription& option : command.options) {
    if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) {
      return paragraph(path + " " + name + (option.value.empty() ? "" : "=" + option.value), option.text);
    }
  }
  for (const CommandDescription& inner : command.commands) {
    if (std::string text = from_options(word, inner, path + " " + inner.name); !text.empty()) {
      return text;
    }
  }
  return "";
}

}  // namespace

std::string word_help(std::string_view word, const CommandDescription& program) {
  const std::string small = in_small_letters(std::string(word));
  return from_glossary(small) + from_choices(small) + from_options(small, program, program.name);
}

}  // namespace dmpc::apps
