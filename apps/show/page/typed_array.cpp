#include "apps/show/page/typed_array.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string>

#include "apps/frontend/system/base64.h"
#include "core/base/expect.h"

namespace dmpc::apps::html {

namespace {

std::size_t bytes_for(std::uint64_t most) { return most < 1U << 8U ? 1 : most < 1U << 16U ? 2 : most >> 32U == 0 ? 4 : 8; }

std::uint64_t number_at(const std::vector<std::byte>& bytes, std::size_t at, std::size_t size) {
  std::uint64_t bits = 0;
  for (std::size_t byte = 0; byte < size; ++byte) {
    bits |= std::to_integer<std::uint64_t>(bytes[at + byte]) << (8 * byte);
  }
  if (size < 8) {
    return bits;
  }
  const double value = std::bit_cast<double>(bits);
  const bool is_whole = value >= 0 && value <= static_cast<double>(exact_number_max) && value == std::floor(value);
  return is_whole ? static_cast<std::uint64_t>(value) : ~std::uint64_t{0};
}

}  // namespace

nlohmann::json typed_array(std::span<const std::uint64_t> values) {
  const std::uint64_t most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  core::expect(most <= exact_number_max, "a script has whole numbers up to 2^53");
  const std::size_t size = bytes_for(most);
  std::string bytes;
  bytes.reserve(values.size() * size);
  for (const std::uint64_t value : values) {
    const std::uint64_t bits = size == 8 ? std::bit_cast<std::uint64_t>(static_cast<double>(value)) : value;
    for (std::size_t byte = 0; byte < size; ++byte) {
      bytes += static_cast<char>(bits >> (8 * byte) & 0xffU);
    }
  }
  return {{"type", (size == 8 ? "f" : "u") + std::to_string(size)}, {"data", base64(bytes)}};
}

std::optional<std::vector<std::uint64_t>> numbers_of(const nlohmann::json& array) {
  if (!array.is_object() || array.size() != 2 || !array.value("type", nlohmann::json()).is_string() ||
      !array.value("data", nlohmann::json()).is_string()) {
    return std::nullopt;
  }
  const std::string& type = array["type"].get_ref<const std::string&>();
  const std::optional<std::vector<std::byte>> bytes = bytes_of_base64(array["data"].get_ref<const std::string&>());
  const bool is_known = type == "u1" || type == "u2" || type == "u4" || type == "f8";
  const std::size_t size = is_known ? static_cast<std::size_t>(type[1] - '0') : 1;
  if (!is_known || !bytes || bytes->size() % size != 0) {
    return std::nullopt;
  }
  std::vector<std::uint64_t> numbers;
  numbers.reserve(bytes->size() / size);
  for (std::size_t at = 0; at < bytes->size(); at += size) {
    numbers.push_back(number_at(*bytes, at, size));
  }
  return numbers;
}

}  // namespace dmpc::apps::html
