#include "apps/show/page/typed_array.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>

#include "apps/edge/show/page/data_url.h"
#include "core/base/expect.h"

namespace dmpc::apps::html {

namespace {

constexpr std::uint64_t exact_max = std::uint64_t{1} << 53U;  ///< of doubles

std::size_t bytes_for(std::uint64_t most) { return most < 1U << 8U ? 1 : most < 1U << 16U ? 2 : most >> 32U == 0 ? 4 : 8; }

}  // namespace

nlohmann::json typed_array(std::span<const std::uint64_t> values) {
  const std::uint64_t most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  core::expect(most <= exact_max, "a script has whole numbers up to 2^53");
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

}  // namespace dmpc::apps::html
