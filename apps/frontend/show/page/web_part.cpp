#include "apps/frontend/show/page/web_part.h"

#include <charconv>
#include <cstddef>
#include <string_view>

#include "apps/frontend/line/words.h"
#include "apps/frontend/system/base64.h"

namespace dmpc::apps::html {

namespace {

std::string from_hexadecimal(std::string_view digits) {
  std::string bytes;
  for (std::size_t at = 0; at + 1 < digits.size(); at += 2) {
    unsigned value = 0;
    std::from_chars(digits.data() + at, digits.data() + at + 2, value, 16);
    bytes += static_cast<char>(value);
  }
  return bytes;
}

std::string sources_of(std::span<const WebPart> parts) {
  const std::string sources =
      joined(parts, "", [&](const WebPart& part) { return " 'sha256-" + base64(from_hexadecimal(part.sha256)) + "'"; });
  return sources.empty() ? " 'none'" : sources;
}

}  // namespace

std::string policy_of(std::span<const WebPart> styles, std::span<const WebPart> scripts) {
  return "default-src 'none'; img-src data:; script-src" + sources_of(scripts) + "; style-src" + sources_of(styles) +
         "; base-uri 'none'; form-action 'none'";
}

}  // namespace dmpc::apps::html
