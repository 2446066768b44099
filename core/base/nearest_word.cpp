#include "core/base/nearest_word.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dmpc::core {
namespace {

/// A longer word is no typing error, and the table grows with the square of the length.
constexpr std::size_t letters_max = 64;
/// A shorter prefix would match too many words.
constexpr std::size_t beginning_min = 3;

char lower(char letter) { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter; }

bool begins_with(std::string_view word, std::string_view beginning) {
  return word.size() >= beginning.size() && edit_distance(word.substr(0, beginning.size()), beginning) == 0;
}

/// The only word that begins with `typed`.
std::optional<std::string> continued(std::string_view typed, std::span<const std::string> words) {
  const auto goes_on = [typed](const std::string& word) { return begins_with(word, typed); };
  if (typed.size() < beginning_min || std::count_if(words.begin(), words.end(), goes_on) != 1) {
    return std::nullopt;
  }
  return *std::find_if(words.begin(), words.end(), goes_on);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      const bool is_same = lower(a[i - 1]) == lower(b[j - 1]);
      least[i][j] = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + (is_same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
        least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
      }
    }
  }
  return least[a.size()][b.size()];
}

std::optional<std::string> nearest_word(std::string_view typed, std::span<const std::string> words) {
  if (typed.empty() || typed.size() > letters_max) {
    return std::nullopt;
  }
  std::optional<std::string> nearest;
  std::size_t least = std::max<std::size_t>(1, typed.size() / 3) + 1;
  for (const std::string& word : words) {
    const std::size_t distance = edit_distance(typed, word);
    if (distance < least && distance < word.size()) {
      least = distance;
      nearest = word;
    }
  }
  return nearest ? nearest : continued(typed, words);
}

std::string did_you_mean(std::string_view typed, std::span<const std::string> words) {
  const std::optional<std::string> word = nearest_word(typed, words);
  return word ? " Did you mean " + *word + "?" : "";
}

}  // namespace dmpc::core
