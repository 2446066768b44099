// What the properties of a PLY file's element mean, and their values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/polygon/ply_header.h"
#include "apps/foreign/polygon/ply_values.h"

namespace dmpc::apps {

/// What a property may mean. The last two are lists, all others single numbers.
enum class PlyRole : std::uint8_t {
  x,
  y,
  z,
  normal_x,
  normal_y,
  normal_z,
  s,
  t,
  red,
  green,
  blue,
  alpha,
  specular_red,
  specular_green,
  specular_blue,
  shine,
  opacity,
  material,
  texture,
  corners,
  corner_places
};
inline constexpr std::size_t ply_roles = 21;

/// The values of one element after the other. Properties that mean nothing here are passed over.
class PlyRow {
 public:
  /// Both outlive it. What is none of the `used` is passed over. Throws core::InputError for a used property that is a list and
  /// ought not to be, or the other way round.
  PlyRow(const PlyElement& element, PlyValues& values, std::initializer_list<PlyRole> used);

  /// Names of properties that are passed over, in the file's order.
  std::vector<std::string> left_out() const;
  bool has(PlyRole role) const { return types_[static_cast<std::size_t>(role)].has_value(); }
  bool has_all(std::initializer_list<PlyRole> roles) const;
  /// Requires that the role is there.
  PlyType type_of(PlyRole role) const { return *types_[static_cast<std::size_t>(role)]; }

  /// Reads the next element. Throws as PlyValues does.
  void read();
  double operator[](PlyRole role) const { return numbers_[static_cast<std::size_t>(role)]; }
  const std::vector<double>& corners() const { return corners_; }
  const std::vector<double>& corner_places() const { return corner_places_; }

 private:
  struct Column {
    PlyProperty property;
    std::optional<PlyRole> role;
  };
  void read_list(const Column& column);

  PlyValues& values_;
  std::vector<Column> columns_;
  std::array<std::optional<PlyType>, ply_roles> types_;
  std::array<double, ply_roles> numbers_{};
  std::vector<double> corners_, corner_places_;
};

}  // namespace dmpc::apps
