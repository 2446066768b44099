#include "apps/foreign/mesh/file_numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "apps/edge/line/shown_text.h"
#include "apps/foreign/text/line_words.h"
#include "apps/foreign/text/xml_tags.h"

namespace dmpc::apps {
namespace {

bool begins_as_number(std::string_view word) {
  const std::size_t sign = word.starts_with('-') || word.starts_with('+') ? 1 : 0;
  const std::size_t point = word.substr(sign).starts_with('.') ? 1 : 0;
  return word.size() > sign + point && std::isdigit(static_cast<unsigned char>(word[sign + point])) != 0;
}

/// `word` is a part of the file.
void check_word(std::string_view file, std::string_view word) {
  if (begins_as_number(word) && !decimal_number(word)) {
    refuse_at(file, static_cast<std::size_t>(word.data() - file.data()), "found '" + clipped(word, 40) + "', expected a number");
  }
}

/// What stands between these letters.
void check_words(std::string_view file, std::string_view part, std::string_view between) {
  for_each_word(part, between, [&](std::string_view word) { check_word(file, word); });
}

/// But for what stands in quotes, or behind `remark` to the end of its line.
void check_plain_text(std::string_view file, std::string_view between, char remark) {
  const std::array<char, 2> marks{'"', remark};
  for (std::size_t at = 0; at < file.size();) {
    const std::size_t end = std::min(file.find_first_of(std::string_view(marks.data(), marks.size()), at), file.size());
    check_words(file, file.substr(at, end - at), between);
    at = end < file.size() && file[end] == '"' ? behind(file, "\"", end + 1) : behind(file, "\n", end);
  }
}

void check_elements(std::string_view file) {
  constexpr std::array names{"x",      "y",         "z",      "v1",     "v2",    "v3", "float", "float_array",
                             "matrix", "translate", "rotate", "lookat", "scale", "p",  "color", "vcount"};
  for_each_tag(file, [&](const Tag& tag) {
    if (std::any_of(names.begin(), names.end(), [&](const char* name) { return tag.is(name); })) {
      check_words(file, content(file, tag), " \t\r\n");
    }
  });
}

}  // namespace

void check_numbers(std::string_view file, const std::string& ending) {
  if (ending == "fbx" && !file.starts_with("Kaydara FBX Binary")) {
    check_plain_text(file, " \t\r\n,:{}", ';');
  } else if (ending == "ase") {
    check_plain_text(file, " \t\r\n,:{}", '"');
  } else if (ending == "amf" || ending == "dae") {
    check_elements(file);
  }
}

}  // namespace dmpc::apps
