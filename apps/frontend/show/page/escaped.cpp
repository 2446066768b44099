#include "apps/frontend/show/page/escaped.h"

#include <cstddef>

#include "apps/frontend/line/utf8.h"

namespace dmpc::apps::html {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

std::string escaped_byte(char byte) {
  switch (byte) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return std::string(1, (byte < ' ' && byte != '\n' && byte != '\t') || byte == '\x7F' ? ' ' : byte);
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t length = first_character(text).bytes;
    safe += length == 0 ? std::string(replacement) : length == 1 ? escaped_byte(text[0]) : std::string(text.substr(0, length));
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

std::string escaped_with_code(std::string_view text) {
  std::string safe;
  for (;;) {
    const std::size_t begin = text.find('`'), end = begin == std::string_view::npos ? begin : text.find('`', begin + 1);
    if (end == std::string_view::npos) {
      return safe + escaped(text);
    }
    safe += escaped(text.substr(0, begin)) + "<code>" + escaped(text.substr(begin + 1, end - begin - 1)) + "</code>";
    text.remove_prefix(end + 1);
  }
}

}  // namespace dmpc::apps::html
