#include "apps/foreign/text/xml_tags.h"

#include "core/base/expect.h"

namespace dmpc::apps {

void refuse_at(std::string_view text, std::size_t at, const std::string& what) {
  throw core::InputError("line " + std::to_string(1 + std::count(text.data(), text.data() + at, '\n')) + ": " + what);
}

std::optional<std::string_view> attribute(const Tag& tag, std::string_view name) {
  for (std::size_t at = tag.inside.find(name); at != std::string_view::npos; at = tag.inside.find(name, at + 1)) {
    const std::string_view rest = tag.inside.substr(at + name.size());
    const bool is_word = at > 0 && std::string_view(" \t\r\n").find(tag.inside[at - 1]) != std::string_view::npos;
    if (is_word && rest.size() > 2 && rest[0] == '=' && (rest[1] == '"' || rest[1] == '\'')) {
      return rest.substr(2, rest.find(rest[1], 2) - 2);
    }
  }
  return std::nullopt;
}

}  // namespace dmpc::apps
