// What a machine has a price for: operations by class, counted by node programs and priced by a machine's model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmpc::nodes {

/// The classes of operations. To the computer they are numbers with a price; what they mean is the programs' business.
enum class Charge : std::uint8_t {
  ray_setup,      ///< a ray made and its walk begun
  cell_step,      ///< of the walk through the grid
  brick_read,     ///< a record of the grid read
  triangle_test,  ///< one primitive of a block against a ray
  sphere_test,
  cone_test,
  shading,        ///< of a hit: geometry, normals, material, lights
  home_lookup,    ///< of a record in a page that is at home
  cached_lookup,  ///< of a record in a page of another home
  page_install,   ///< a page that has come put into a frame
  ray_packing,    ///< a ray put into a packet or taken out of one
  tile_read       ///< a tile of a texture found and read
};
inline constexpr std::size_t charge_count = 12;
inline constexpr std::array<std::string_view, charge_count> charge_names = {
    "ray_setup", "cell_step",   "brick_read",    "triangle_test", "sphere_test", "cone_test",
    "shading",   "home_lookup", "cached_lookup", "page_install",  "ray_packing", "tile_read"};

/// Operations of each class: what a program has done since the start.
struct Charges {
  std::array<std::uint64_t, charge_count> count{};

  std::uint64_t& operator[](Charge charge) { return count[static_cast<std::size_t>(charge)]; }
  std::uint64_t operator[](Charge charge) const { return count[static_cast<std::size_t>(charge)]; }
};

}  // namespace dmpc::nodes
