// Interprets the statements of a pbrt scene in order, with the graphics state that they modify.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/pbrt/camera.h"
#include "apps/foreign/pbrt/lights.h"
#include "apps/foreign/pbrt/parameters.h"
#include "apps/foreign/pbrt/surfaces.h"
#include "apps/foreign/pbrt/textures.h"
#include "apps/foreign/pbrt/tokens.h"
#include "apps/formats/resolution.h"

namespace dmpc::apps::pbrt {

/// The maximum nesting depth of AttributeBegin, ObjectBegin and similar statements.
inline constexpr std::size_t attribute_levels_max = 100'000;

class Statements {
 public:
  /// `files` outlives this object.
  Statements(const std::string& path, SceneFiles& files);

  /// Interprets all statements. Call it once.
  PlacedFile read(const std::optional<Resolution>& size);

 private:
  using Statement = void (Statements::*)(const Token& name);
  static const std::map<std::string_view, Statement>& all();

  /// The state that AttributeBegin saves and AttributeEnd restores.
  struct State {
    Transform ctm;
    std::uint32_t surface = 0;
    std::optional<AreaLight> light;
    bool is_reversed = false;
    bool moves_start = true;                               ///< transforms apply to the time when the shutter opens
    std::map<std::string, Parameters::Defaults> defaults;  ///< per kind of owner: shapes, lights, materials, ...
  };
  enum class Opening : std::uint8_t { attribute, object, import };
  struct Saved {
    State state;
    Opening opening;
    Place place;
    std::size_t file_level;
  };
  /// The shapes of an object, each with its own CTM.
  struct Object {
    std::vector<ShapePlace> places;
    GeometrySize anew;  ///< geometry that is created again for each instance after the first
    bool is_there = false;
  };

  /// An instance of an object that has not been defined yet.
  struct Awaited {
    std::string object;
    Transform ctm;
    Token name;
  };

  /// The components of a shape's final material.
  struct Look {
    std::uint32_t surface = 0;
    core::Vec3d emission;
    double opacity = 1;
    bool is_light = false;
    auto key() const {
      return std::array<double, 6>{static_cast<double>(surface), emission.x, emission.y, emission.z, opacity,
                                   is_light ? 1.0 : 0.0};
    }
  };

  void transform_statement(const Token& name);
  void matrix(const Token& name);
  void coordinate_system(const Token& name);
  void coordinates(const Token& name);
  void active_transform(const Token& name);
  void reverse_orientation(const Token& name);
  void begin(const Token& name);
  void end(const Token& name);
  void attribute(const Token& name);
  void object_begin(const Token& name);
  void object_instance(const Token& name);
  void add_instance(Object& shapes, const Transform& ctm, const Token& name);
  void add_awaited();
  void film(const Token& name);
  void camera(const Token& name);
  void color_space(const Token& name);
  void of_other_renderers(const Token& name);
  void integrator(const Token& name);
  void sampler(const Token& name);
  void option(const Token& name);
  void medium_interface(const Token& name);
  void world_begin(const Token& name);
  void texture(const Token& name);
  void material(const Token& name);
  void make_named_material(const Token& name);
  std::uint32_t announced(const std::optional<std::string>& material, const std::string& kind, const Parameters& all);
  void named_material(const Token& name);
  void area_light(const Token& name);
  void light(const Token& name);
  void shape(const Token& name);
  void include(const Token& name);
  void import(const Token& name);
  void of_older_versions(const Token& name);

  void save(Opening opening, const Place& place);
  void restore(Opening opening, const Token& name);
  void end_imports();
  void apply(const Token& name, const Transform& map);
  void check_map(const Token& name, const Transform& map) const;
  std::vector<double> numbers(const Token& name, std::size_t count);
  std::string text(const Token& name, const char* what);
  /// Reads parameters, with the defaults of Attribute statements. finish() counts the unused ones by the parameter table.
  Parameters parameters(const std::string& owner, const Token& name, const char* kind);
  void finish(const Parameters& parameters, const std::string& statement, const std::string& kind);
  Exposure exposure() const;
  void add_shape(PlacedShape shape, const Parameters& parameters);
  void set_look(PlacedShape& shape, const Parameters& parameters);
  std::size_t look_number(const Look& look);
  /// Adds to the scene's totals; a failure is reported at `said`.
  void count(const GeometrySize& more, const Place& said);
  void give_materials();
  void add_unseen_lights();
  void drop_undrawn();
  void check_ended() const;
  void turn_round(const Transform& turn);

  SceneFiles& files_;
  Tokens tokens_;
  Notes notes_;
  PlacedFile file_;
  Textures textures_;
  Surfaces surfaces_;
  State state_;
  std::vector<Saved> saved_;
  std::map<std::string, Transform> systems_;
  std::map<std::string, Object> objects_;
  Object* open_object_ = nullptr;
  std::vector<Awaited> awaited_;
  /// Pbrt creates image textures first, then other textures of numbers and of colours, each in file order, and materials last.
  std::array<std::vector<std::function<void()>>, 3> awaited_looks_;
  std::vector<Look> looks_;
  std::vector<std::pair<std::uint32_t, FileLight>> unseen_;  ///< with their surfaces
  std::map<std::array<double, 6>, std::size_t> look_numbers_;
  Film film_;
  std::optional<Camera> camera_;
  bool is_world_ = false;
};

}  // namespace dmpc::apps::pbrt
