// The numbers of an array in a page's data, read as its script does.
#pragma once

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dmpc::tests {

/// The data of a page, as JSON text.
inline std::string data_in(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin);
  return at == std::string::npos ? "" : page.substr(at + begin.size(), page.find("</script>", at) - at - begin.size());
}

inline std::string bytes_of_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size() && text[i] != '='; ++i) {
    bits = bits << 6U | static_cast<std::uint32_t>(letters.find(text[i]));
    if (i % 4 > 0) {
      bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 0xffU);
    }
  }
  return bytes;
}

inline std::vector<std::uint64_t> numbers_in(const nlohmann::json& array) {
  const std::string type = array.at("type"), bytes = bytes_of_base64(array.at("data"));
  const auto size = static_cast<std::size_t>(type.at(1) - '0');
  std::vector<std::uint64_t> numbers;
  for (std::size_t at = 0; at + size <= bytes.size(); at += size) {
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; byte < size; ++byte) {
      bits |= std::uint64_t{static_cast<unsigned char>(bytes[at + byte])} << (8 * byte);
    }
    numbers.push_back(type[0] == 'f' ? static_cast<std::uint64_t>(std::bit_cast<double>(bits)) : bits);
  }
  return numbers;
}

}  // namespace dmpc::tests
