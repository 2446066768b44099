// Escapes text for HTML.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps::html {

/// Escapes `text` so that a browser shows it literally, between tags and in attributes within double quotes. Bytes that are not
/// UTF-8, as in a file's name, become U+FFFD; control characters except line ends and tabs become spaces.
std::string escaped(std::string_view text);

/// As above; text between two backticks becomes code.
std::string escaped_with_code(std::string_view text);

}  // namespace dmpc::apps::html
