// How much work a node has done, as one number: counted operations, each with its price. Decides how space is shared out, never
// what the picture is.
#pragma once

#include <array>
#include <cstdint>

#include "core/trace/operations.h"

namespace dmpc::dataflow {

/// What one operation of each kind costs, in picoseconds. The defaults were measured: see work.cpp.
struct WorkPrices {
  std::uint64_t ray_ps = 0;  ///< to make a ray and to begin its walk
  std::uint64_t cell_step_ps = 0;
  std::uint64_t brick_read_ps = 0;
  std::array<std::uint64_t, core::primitive_kind_count> primitive_test_ps{};  ///< of one lane
  std::uint64_t shading_ps = 0;                                               ///< of a hit: geometry, normals, material
  std::uint64_t tile_read_ps = 0;                                             ///< of a texture, with its entry in the table
};

/// Prices of one core of the machine on which they were measured.
extern const WorkPrices measured_prices;

/// The work of so many operations, in picoseconds. Thread safety: pure.
std::uint64_t work_of(const core::Operations& operations, const WorkPrices& prices = measured_prices);

}  // namespace dmpc::dataflow
