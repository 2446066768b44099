#include "apps/foreign/mesh/obj_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// The numbers of vertices, texture coordinates and normals, in the order in which a corner names them.
using Counts = std::array<std::int64_t, 3>;
constexpr std::array<const char*, 3> nouns = {"vertex", "texture coordinate", "normal"};

bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; }

/// The first word, which is cut off.
std::string_view take_word(std::string_view& line) {
  const auto begin = std::find_if_not(line.begin(), line.end(), is_blank);
  const auto end = std::find_if(begin, line.end(), is_blank);
  const std::string_view word(begin, static_cast<std::size_t>(end - begin));
  line.remove_prefix(static_cast<std::size_t>(end - line.begin()));
  return word;
}

/// Calls take(line, its number) for each, as it stands.
template <class Take>
void for_each_line(std::string_view file, const Take& take) {
  for (std::size_t number = 1; !file.empty(); ++number) {
    const std::size_t end = std::min(file.find('\n'), file.size());
    take(file.substr(0, end), number);
    file.remove_prefix(std::min(end + 1, file.size()));
  }
}

void add(std::string_view word, Counts& counts) {
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    counts[kind] += word == std::array<std::string_view, 3>{"v", "vt", "vn"}[kind] ? 1 : 0;
  }
}

class Checker {
 public:
  explicit Checker(const Counts& all) : all_(all) {}

  void line(std::string_view line, std::size_t number) {
    std::string_view rest = line;
    if (!is_face_) {
      const std::string_view word = take_word(rest);
      add(word, so_far_);
      is_face_ = word == "f";
    }
    bool goes_on = false;
    while (is_face_) {
      const std::string_view word = take_word(rest);
      goes_on = word == "\\";
      if (word.empty() || goes_on || word.front() == '#') {
        break;
      }
      corner(word, number);
    }
    is_face_ = is_face_ && goes_on;
  }

 private:
  /// "3", "3/1", "3//2" or "3/1/2". What is no number is left to Assimp.
  void corner(std::string_view text, std::size_t number) const {
    for (std::size_t kind = 0; kind < nouns.size() && !text.empty(); ++kind) {
      const std::size_t end = std::min(text.find('/'), text.size());
      std::int64_t index = 0;
      const auto [last, error] = std::from_chars(text.data(), text.data() + end, index);
      if (error == std::errc{} && last == text.data() + end && (index > all_[kind] || index < -so_far_[kind])) {
        throw core::InputError("line " + std::to_string(number) + ": the face has " + nouns[kind] + " " + std::to_string(index) +
                               ", which does not exist: there are " + std::to_string(index > 0 ? all_[kind] : so_far_[kind]) +
                               (index > 0 ? "" : " before it"));
      }
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  Counts all_, so_far_{};
  bool is_face_ = false;  ///< the line goes on with corners of a face
};

}  // namespace

void check_obj(std::string_view file) {
  Counts all{};
  for_each_line(file, [&](std::string_view line, std::size_t) { add(take_word(line), all); });
  Checker checker(all);
  for_each_line(file, [&](std::string_view line, std::size_t number) { checker.line(line, number); });
}

}  // namespace dmpc::apps
