// Maps the properties of a PLY element to their meanings and reads their values.
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

/// Meanings of properties. The last two are lists, all others are single numbers.
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

/// The values of one element at a time. Unknown properties are skipped.
class PlyRow {
 public:
  /// `element` and `values` outlive this object. Properties that are not in `used` are skipped. Throws core::InputError if a
  /// used property is a list but should be a number, or vice versa.
  PlyRow(const PlyElement& element, PlyValues& values, std::initializer_list<PlyRole> used);

  /// Returns the names of skipped properties, in the file's order.
  std::vector<std::string> left_out() const;
  bool has(PlyRole role) const { return types_[static_cast<std::size_t>(role)].has_value(); }
  bool has_all(std::initializer_list<PlyRole> roles) const;
  /// Requires that the element has the role.
  PlyType type_of(PlyRole role) const { return *types_[static_cast<std::size_t>(role)]; }

  /// Reads the next element. Throws the exceptions of PlyValues.
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
