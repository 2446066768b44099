#include "core/database/structure.h"

#include <numeric>
#include <utility>

#include "core/base/sampling.h"
#include "core/database/record_writer.h"

namespace dmpc::core {

std::vector<Address> scattered_places(std::span<const std::uint16_t> sizes, std::size_t front_bytes, std::size_t page_size) {
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[mix(i) % i]);
  }
  std::vector<Address> places(sizes.size());
  std::size_t end = front_bytes;
  for (const std::uint32_t record : order) {
    const std::size_t offset = place_in_page(end, sizes[record], page_size);
    places[record] = Address{static_cast<std::uint32_t>(offset / record_alignment)};
    end = offset + sizes[record];
  }
  return places;
}

}  // namespace dmpc::core
