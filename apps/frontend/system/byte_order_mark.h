// The mark with which some editors begin UTF-8 files.
#pragma once

#include <string_view>

namespace dmpc::apps {

inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

inline std::string_view without_mark(std::string_view file) {
  return file.starts_with(byte_order_mark) ? file.substr(byte_order_mark.size()) : file;
}

}  // namespace dmpc::apps
