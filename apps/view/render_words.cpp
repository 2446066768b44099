#include "apps/view/render_words.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace dmpc::apps {

namespace {

/// Options that mean something else to `render`, or nothing; each is followed by its value unless it has none.
constexpr std::array<std::string_view, 3> left_out = {"--camera", "--resolution", "--port"};

}  // namespace

std::vector<std::string> render_words(std::span<const std::string> view_words, const std::string& camera, const Resolution& size,
                                      const std::string& picture) {
  const auto end = std::find(view_words.begin(), view_words.end(), "--");
  std::vector<std::string> words = {"dmpc", "render"};
  bool is_value = false;
  for (auto word = view_words.begin() + std::min<std::ptrdiff_t>(2, end - view_words.begin()); word != end; ++word) {
    const auto is_named = [&](std::string_view name) { return word->starts_with(name) && word->substr(name.size(), 1) == "="; };
    const bool is_left_out = std::find(left_out.begin(), left_out.end(), *word) != left_out.end();
    if (!is_value && !is_left_out && *word != "--quiet" && std::none_of(left_out.begin(), left_out.end(), is_named)) {
      words.push_back(*word);
    }
    is_value = is_left_out && !is_value;
  }
  words.push_back("--camera=" + camera);
  words.push_back("--resolution=" + std::to_string(size.width) + "x" + std::to_string(size.height));
  words.insert(words.end(), {"-o", picture});
  words.insert(words.end(), end, view_words.end());
  return words;
}

}  // namespace dmpc::apps
