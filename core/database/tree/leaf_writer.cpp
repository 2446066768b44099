#include "core/database/tree/leaf_writer.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace dmpc::core {

void LeafWriter::write(const LeafShape& shape, std::span<const std::uint32_t> ids, Address address) const {
  std::array<std::byte, record_bytes_max> record;
  LeafHeader header{.kind = shape.kind, .count = shape.count};
  header.plane = shape.plane != 0 ? planes_[shape.plane - 1].stored_as : std::uint8_t{0};
  const std::size_t rows = value_count(shape.kind);
  for (std::size_t lane = 0; lane < shape.count; ++lane) {
    const std::uint32_t id = ids[lane];
    header.shared_lanes |= static_cast<std::uint8_t>(primitives_[id].plane() != 0 ? 1U << lane : 0U);
    const auto put = [&](std::size_t row, const auto& value) {
      static_assert(sizeof(value) == 4);
      std::memcpy(record.data() + sizeof(header) + 4 * (row * shape.count + lane), &value, sizeof(value));
    };
    for (std::size_t row = 0; row < rows; ++row) {
      put(row, primitives_[id].value[row]);
    }
    put(rows, reported_.empty() ? id : reported_[id]);
    put(rows + 1, shading_[id]);
  }
  std::memcpy(record.data(), &header, sizeof(header));
  if (header.has_plane()) {
    const FacePlane& plane = planes_[shape.plane - 1];
    std::memcpy(record.data() + leaf_bytes(shape.kind, shape.count), &plane, sizeof(FacePlane));
  }
  writer_.write(address, 0, std::as_bytes(std::span(record)).first(shape.bytes()));
}

}  // namespace dmpc::core
