// Text as HTML shows it.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps::html {

/// `text` so that a browser shows it as it is, between tags and in attributes within double quotes. What is no UTF-8, such as a
/// byte of a file's name, becomes U+FFFD; control characters but line ends and tabs become spaces.
std::string escaped(std::string_view text);

/// `text` so escaped, but what stands between two backticks is code.
std::string escaped_with_code(std::string_view text);

}  // namespace dmpc::apps::html
