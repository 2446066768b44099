#include "apps/foreign/polygon/ply_row.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

bool is_list_role(PlyRole role) { return role >= PlyRole::corners; }

/// Texture coordinates have many names: those of Blender (s, t), of Assimp, and of MeshLab (texture_u, texture_v).
std::optional<PlyRole> role_of(std::string_view name) {
  using enum PlyRole;
  static const std::map<std::string_view, PlyRole> roles = {{"x", x},
                                                            {"y", y},
                                                            {"z", z},
                                                            {"nx", normal_x},
                                                            {"ny", normal_y},
                                                            {"nz", normal_z},
                                                            {"s", s},
                                                            {"u", s},
                                                            {"tx", s},
                                                            {"texture_u", s},
                                                            {"t", t},
                                                            {"v", t},
                                                            {"ty", t},
                                                            {"texture_v", t},
                                                            {"red", red},
                                                            {"r", red},
                                                            {"diffuse_red", red},
                                                            {"green", green},
                                                            {"g", green},
                                                            {"diffuse_green", green},
                                                            {"blue", blue},
                                                            {"b", blue},
                                                            {"diffuse_blue", blue},
                                                            {"alpha", alpha},
                                                            {"a", alpha},
                                                            {"diffuse_alpha", alpha},
                                                            {"specular_red", specular_red},
                                                            {"specular_green", specular_green},
                                                            {"specular_blue", specular_blue},
                                                            {"specular_power", shine},
                                                            {"opacity", opacity},
                                                            {"material_index", material},
                                                            {"texnumber", texture},
                                                            {"vertex_indices", corners},
                                                            {"vertex_index", corners},
                                                            {"texcoord", corner_places}};
  const auto found = roles.find(name);
  return found == roles.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

PlyRow::PlyRow(const PlyElement& element, PlyValues& values, std::initializer_list<PlyRole> used) : values_(values) {
  columns_.reserve(element.properties.size());
  for (const PlyProperty& property : element.properties) {
    auto role = role_of(property.name);
    if (role && (has(*role) || std::find(used.begin(), used.end(), *role) == used.end())) {
      role.reset();  // a second name for the same role, or an unused role
    }
    if (role && is_list_role(*role) != property.count_type.has_value()) {
      throw core::InputError("the property '" + std::string(property.name) + "' of the element '" + std::string(element.name) +
                             (is_list_role(*role) ? "' is one number; expected a list" : "' is a list; expected one number"));
    }
    if (role) {
      types_[static_cast<std::size_t>(*role)] = property.type;
    }
    columns_.push_back({property, role});
  }
}

std::vector<std::string> PlyRow::left_out() const {
  std::vector<std::string> names;
  for (const Column& column : columns_) {
    if (!column.role) {
      names.emplace_back(column.property.name);
    }
  }
  return names;
}

bool PlyRow::has_all(std::initializer_list<PlyRole> roles) const {
  return std::all_of(roles.begin(), roles.end(), [this](PlyRole role) { return has(role); });
}

void PlyRow::read_list(const Column& column) {
  const PlyType type = column.property.type, count_type = *column.property.count_type;
  if (!column.role) {
    values_.skip(type, values_.next_length(count_type, type));
    return;
  }
  values_.next_list(count_type, type, *column.role == PlyRole::corners ? corners_ : corner_places_);
}

void PlyRow::read() {
  values_.begin_element();
  for (const Column& column : columns_) {
    if (column.property.count_type) {
      read_list(column);
    } else if (column.role) {
      numbers_[static_cast<std::size_t>(*column.role)] = values_.next(column.property.type);
    } else {
      values_.skip(column.property.type, 1);
    }
  }
}

}  // namespace dmpc::apps
