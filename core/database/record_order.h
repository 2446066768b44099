// Where records lie in pages, relative to where they lie in space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/record/record.h"

namespace dmpc::core {

enum class RecordOrder : std::uint8_t {
  spatial,    ///< neighbours in space share pages
  scattered,  ///< whatever lies in a page comes from anywhere: what a database costs whose records have no order in space
};

/// Places for records of these sizes in pages behind `front_bytes`, densely, in an order that has nothing to do with theirs and
/// is always the same; none crosses a page's border. Place i is record i's.
std::vector<Address> scattered_places(std::span<const std::uint16_t> sizes, std::size_t front_bytes, std::size_t page_size);

}  // namespace dmpc::core
