// Converts the materials of a pbrt scene.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/pbrt/textures.h"

namespace dmpc::apps::pbrt {

/// A purely diffuse surface, or one with microfacets.
struct Surface {
  TextureValue color;
  bool has_facets = false, is_thin = false;
  bool is_drawn = true;    ///< false for interfaces that only separate two media
  MetallicSurface facets;  ///< without its base colour, which is `color`
};

/// Converts by the table in apps/foreign/README.md. A final material combines a surface, the shape's emission and its opacity.
class Surfaces {
 public:
  /// Surface 0 is pbrt's default before any Material statement.
  Surfaces(Notes& notes, const Textures& textures);

  /// Returns the number of the surface of a Material statement, or of a MakeNamedMaterial statement with this name; make()
  /// creates it once its textures exist. Throws core::InputError for kinds of pbrt-v3, and for a duplicate name.
  std::uint32_t announce(const std::optional<std::string>& name, const std::string& kind, const Parameters& parameters);
  /// Throws core::InputError for a kind that pbrt-v4 does not have.
  void make(std::uint32_t slot, const std::string& kind, const Parameters& parameters);
  bool is_made(std::uint32_t number) const { return slots_[number].surface.has_value(); }
  /// Returns the number of the named surface, which may be defined later.
  std::uint32_t named(const std::string& name, const Place& place);

  /// Call it after the last statement. Throws core::InputError for an undefined name, and for a mixture that contains itself.
  void settle(const Tokens& tokens);
  /// Requires settle().
  const Surface& at(std::uint32_t number) const { return *slots_[number].surface; }
  static FileMaterial material_of(const Surface& surface, const core::Vec3d& emission, double opacity);

 private:
  struct Mixture {
    std::uint32_t first, second;
    double amount;
  };
  struct Slot {
    std::optional<Surface> surface;
    std::optional<Mixture> mixture;
    std::string name;
    Place place;
    bool is_announced = false, is_being_mixed = false;
  };

  Surface surface_of(const std::string& kind, const Parameters& parameters) const;
  core::Vec3d metal(const Parameters& parameters, const std::string& prefix, double below) const;
  Surface conductor(const Parameters& parameters, const std::string& prefix) const;
  Surface coated_conductor(const Parameters& parameters) const;
  Surface coated(const Parameters& parameters) const;
  Surface glass(const Parameters& parameters, bool is_thin) const;
  Surface diffuse(const Parameters& parameters, const char* name, double fallback) const;
  double roughness(const Parameters& parameters, const std::string& prefix, double fallback) const;
  double index(const Parameters& parameters, const char* name, double fallback) const;
  Mixture mixture_of(const Parameters& parameters);
  const Surface& settled(std::uint32_t number, int level, const Tokens& tokens);

  Notes& notes_;
  const Textures& textures_;
  std::vector<Slot> slots_;
  std::map<std::string, std::uint32_t> names_;
};

}  // namespace dmpc::apps::pbrt
