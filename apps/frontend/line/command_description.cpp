#include "apps/frontend/line/command_description.h"

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

}  // namespace

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

}  // namespace dmpc::apps
