#include "apps/foreign/pbrt/reader.h"

#include <algorithm>
#include <array>
#include <cmath>
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
#include "apps/foreign/pbrt/affine.h"
#include "apps/foreign/pbrt/camera.h"
#include "apps/foreign/pbrt/lights.h"
#include "apps/foreign/pbrt/parameter_table.h"
#include "apps/foreign/pbrt/parameters.h"
#include "apps/foreign/pbrt/shapes.h"
#include "apps/foreign/pbrt/surfaces.h"
#include "apps/foreign/pbrt/textures.h"
#include "apps/foreign/pbrt/tokens.h"
#include "apps/foreign/text/line_words.h"
#include "apps/formats/resolution.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;

constexpr double number_max = 1e30, degrees_max = 1e6;
/// The depth of an integrator without one.
constexpr std::int64_t depth_unsaid = 5;
/// Rounding of pbrt's numbers, which are floats in text and mesh files.
constexpr double float_rounding = 0x1p-25;

std::string quoted(const std::string& word) { return "\"" + clipped(word, 60) + "\""; }

Vec3d vector_at(const std::vector<double>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// The maximum nesting depth of AttributeBegin, ObjectBegin and similar statements.
constexpr std::size_t attribute_levels_max = 100'000;

/// Interprets the statements of a scene in order, with the graphics state that they modify.
class Statements {
 public:
  /// `files` outlives this object.
  Statements(const std::string& path, SceneFiles& files)
      : files_(files), tokens_(path, files), textures_(notes_, file_.pictures), surfaces_(notes_, textures_) {
    file_.bounces = static_cast<int>(depth_unsaid - 1);
  }

  /// Interprets all statements. Call it once.
  PlacedFile read(const std::optional<Resolution>& size) {
    for (Token token = tokens_.next(); token.kind != TokenKind::end; token = tokens_.next()) {
      end_imports();
      const auto found = token.kind == TokenKind::word ? all().find(token.text) : all().end();
      if (found == all().end()) {
        tokens_.fail(token.place, quoted(token.kind == TokenKind::open    ? "["
                                         : token.kind == TokenKind::close ? "]"
                                                                          : token.text) +
                                      " is no statement; expected one such as Shape, or the end of the file");
      }
      (this->*found->second)(token);
    }
    end_imports();
    check_ended();
    add_awaited();
    for (const auto& list : awaited_looks_) {
      std::ranges::for_each(list, [](const auto& make) { make(); });
    }
    surfaces_.settle(tokens_);
    give_materials();
    add_unseen_lights();
    drop_undrawn();
    const Camera camera = camera_.value_or(Camera{});
    const bool is_turned = sees_left_handed(camera);
    const Transform turn = is_turned ? scaling(Vec3d{-1, 1, 1}) : Transform{};
    if (const auto view = view_of(camera, film_, size, turn)) {
      file_.views.push_back({.name = "", .view = view});
    }
    file_.is_lit_whole = true;
    turn_round(turn);
    file_.coordinate_rounding = float_rounding;
    if (is_turned) {
      file_.notes.emplace_back("the scene's coordinates are left-handed: x is turned round");
    }
    notes_.add_to(file_.notes);
    return std::move(file_);
  }

 private:
  using Statement = void (Statements::*)(const Token& name);

  static const std::map<std::string_view, Statement>& all() {
    static const std::map<std::string_view, Statement> statements{
        {"Accelerator", &Statements::of_other_renderers},
        {"ActiveTransform", &Statements::active_transform},
        {"AreaLightSource", &Statements::area_light},
        {"Attribute", &Statements::attribute},
        {"AttributeBegin", &Statements::begin},
        {"AttributeEnd", &Statements::end},
        {"Camera", &Statements::camera},
        {"ColorSpace", &Statements::color_space},
        {"ConcatTransform", &Statements::matrix},
        {"CoordSysTransform", &Statements::coordinates},
        {"CoordinateSystem", &Statements::coordinate_system},
        {"Film", &Statements::film},
        {"Identity", &Statements::transform_statement},
        {"Import", &Statements::import},
        {"Include", &Statements::include},
        {"Integrator", &Statements::integrator},
        {"LightSource", &Statements::light},
        {"LookAt", &Statements::transform_statement},
        {"MakeNamedMaterial", &Statements::make_named_material},
        {"MakeNamedMedium", &Statements::of_other_renderers},
        {"Material", &Statements::material},
        {"MediumInterface", &Statements::medium_interface},
        {"NamedMaterial", &Statements::named_material},
        {"ObjectBegin", &Statements::object_begin},
        {"ObjectEnd", &Statements::end},
        {"ObjectInstance", &Statements::object_instance},
        {"Option", &Statements::option},
        {"PixelFilter", &Statements::of_other_renderers},
        {"Renderer", &Statements::of_older_versions},
        {"ReverseOrientation", &Statements::reverse_orientation},
        {"Rotate", &Statements::transform_statement},
        {"Sampler", &Statements::sampler},
        {"Scale", &Statements::transform_statement},
        {"Shape", &Statements::shape},
        {"SurfaceIntegrator", &Statements::of_older_versions},
        {"Texture", &Statements::texture},
        {"Transform", &Statements::matrix},
        {"TransformBegin", &Statements::begin},
        {"TransformEnd", &Statements::end},
        {"TransformTimes", &Statements::transform_statement},
        {"Translate", &Statements::transform_statement},
        {"Volume", &Statements::of_older_versions},
        {"VolumeIntegrator", &Statements::of_older_versions},
        {"WorldBegin", &Statements::world_begin},
        {"WorldEnd", &Statements::of_older_versions},
    };
    return statements;
  }

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

  void transform_statement(const Token& name) {
    if (name.text == "Identity") {
      state_.ctm = state_.moves_start ? Transform{} : state_.ctm;
    } else if (name.text == "TransformTimes") {
      numbers(name, 2);
    } else if (name.text == "Translate") {
      apply(name, translation(vector_at(numbers(name, 3), 0)));
    } else if (name.text == "Scale") {
      apply(name, scaling(vector_at(numbers(name, 3), 0)));
    } else if (name.text == "Rotate") {
      const std::vector<double> values = numbers(name, 4);
      const Vec3d axis = vector_at(values, 1);
      if (!(length(axis) > 0 && length(axis) <= number_max && std::abs(values[0]) <= degrees_max)) {
        tokens_.fail(name.place, "Rotate has an axis without a direction, or more than 1e6 degrees");
      }
      apply(name, rotation(values[0], axis));
    } else {
      const std::vector<double> values = numbers(name, 9);
      const auto map = look_at(vector_at(values, 0), vector_at(values, 3), vector_at(values, 6));
      if (!map) {
        tokens_.fail(name.place,
                     "LookAt looks nowhere: from and at are one point, or up points along the way from one to the other");
      }
      apply(name, *map);
    }
  }

  /// Sixteen numbers in column-major order.
  void matrix(const Token& name) {
    const std::vector<double> m = numbers(name, 16);
    constexpr double rounding = 1e-6;
    if (!(std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1) <= rounding)) {
      tokens_.fail(name.place,
                   name.text + " makes lines meet that are parallel; expected 0, 0, 0 and 1 for its numbers 4, 8, 12 and 16");
    }
    const Transform map{{{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}}, {m[12], m[13], m[14]}};
    if (name.text == "Transform") {
      state_.ctm = state_.moves_start ? Transform{} : state_.ctm;
    }
    apply(name, map);
  }

  void coordinate_system(const Token& name) { systems_.insert_or_assign(text(name, "a name"), state_.ctm); }

  void coordinates(const Token& name) {
    const std::string system = text(name, "a name");
    const auto found = systems_.find(system);
    if (found == systems_.end()) {
      notes_.count("names of CoordSysTransform that no CoordinateSystem has, which move nothing");
      return;
    }
    state_.ctm = found->second;
  }

  void active_transform(const Token& name) {
    const Token which = tokens_.next();
    if (which.text != "StartTime" && which.text != "EndTime" && which.text != "All") {
      tokens_.fail(which.place, name.text + " has " + quoted(which.text) + ", expected StartTime, EndTime or All");
    }
    state_.moves_start = which.text != "EndTime";
    notes_.count("what moves while the shutter is open, shown as it stands at first", state_.moves_start ? 0 : 1);
  }

  void reverse_orientation(const Token& /*name*/) { state_.is_reversed = !state_.is_reversed; }
  /// In version 4, TransformBegin and TransformEnd are AttributeBegin and AttributeEnd.
  void begin(const Token& name) { save(Opening::attribute, name.place); }

  void end(const Token& name) {
    const Opening opening = name.text == "ObjectEnd" ? Opening::object : Opening::attribute;
    restore(opening, name);
    if (opening == Opening::object) {
      open_object_ = nullptr;
    }
  }

  void attribute(const Token& name) {
    const std::string kind = text(name, "what it is of");
    if (kind != "shape" && kind != "light" && kind != "material" && kind != "medium" && kind != "texture") {
      tokens_.fail(name.place, "Attribute is of " + quoted(kind) + ", expected shape, light, material, medium or texture");
    }
    Parameters more(tokens_, "Attribute " + quoted(kind), name.place);
    Parameters::List list = state_.defaults[kind] ? *state_.defaults[kind] : Parameters::List{};
    for (Parameter& one : more.take_list()) {
      list.push_back(std::make_shared<const Parameter>(std::move(one)));  // later values take precedence
    }
    constexpr std::size_t most = 1000;
    if (list.size() > most) {
      tokens_.fail(name.place, "Attribute says more than 1,000 parameters");
    }
    state_.defaults[kind] = std::make_shared<const Parameters::List>(std::move(list));
  }

  void object_begin(const Token& name) {
    const std::string object = text(name, "a name");
    if (open_object_ != nullptr) {
      tokens_.fail(name.place, "ObjectBegin stands within another object, where pbrt allows none");
    }
    const auto [found, is_new] = objects_.try_emplace(object);
    if (!is_new) {
      tokens_.fail(name.place, "there is an object " + quoted(object) + " already");
    }
    save(Opening::object, name.place);
    open_object_ = &found->second;
  }

  void object_instance(const Token& name) {
    const std::string object = text(name, "a name");
    if (open_object_ != nullptr) {
      tokens_.fail(name.place, "ObjectInstance stands within an object, where pbrt allows none");
    }
    if (const auto found = objects_.find(object); found != objects_.end()) {
      add_instance(found->second, state_.ctm, name);
    } else {
      count({.bytes = sizeof(Awaited) + object.size()}, name.place);
      awaited_.push_back({object, state_.ctm, name});
    }
  }

  /// Prepends the transform to those of the object's shapes. Only here is an instance's transform made.
  void add_instance(Object& shapes, const Transform& ctm, const Token& name) {
    count(shapes.is_there ? shapes.anew : GeometrySize{}, name.place);
    shapes.is_there = true;
    for (const ShapePlace& place : shapes.places) {
      const ShapePlace instance{place.shape, composed(ctm, place.world)};
      check_map(name, instance.world);
      ++file_.shapes[place.shape].uses;
      file_.places.push_back(instance);
    }
  }

  /// Adds instances whose objects were defined after them.
  void add_awaited() {
    for (const Awaited& one : awaited_) {
      const auto found = objects_.find(one.object);
      if (found == objects_.end()) {
        tokens_.fail(one.name.place, "no object " + quoted(one.object) + " is there: no ObjectBegin has that name");
      }
      add_instance(found->second, one.ctm, one.name);
    }
  }

  void film(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "");
    film_ = film_of(kind, all, notes_);
    finish(all, name.text, kind);
  }

  void camera(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "");
    camera_ = camera_of(kind, all, state_.ctm, notes_);
    finish(all, name.text, kind);
    systems_.insert_or_assign("camera", *inverse_of(state_.ctm));
  }

  void color_space(const Token& name) {
    const std::string space = text(name, "its name");
    notes_.count("colours of the space " + quoted(space) + ", shown as if they were of sRGB", space == "srgb" ? 0 : 1);
  }

  /// Acceleration structures, filters and media: they concern only pbrt's rendering, or are not shown.
  void of_other_renderers(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "");
    if (name.text != "MakeNamedMedium") {
      finish(all, name.text, kind);
    }
    const bool is_ours = kind == "box" && all.number("xradius", 0.5) == 0.5 && all.number("yradius", 0.5) == 0.5;
    notes_.count("filters of pixels, in place of which a pixel is the mean of what falls on it",
                 name.text == "PixelFilter" && !is_ours ? 1 : 0);
  }

  /// Pbrt's depth counts hits with direct lighting; ours have one such hit without a bounce.
  void integrator(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "");
    const std::int64_t depth = all.integer("maxdepth", depth_unsaid);
    if (depth < 0) {
      all.fail("its maxdepth is " + std::to_string(depth) + ", expected 0 or more");
    }
    file_.bounces = static_cast<int>(std::clamp<std::int64_t>(depth - 1, 0, core::Scene::bounces_max));
    if (depth == 0 || depth - 1 > core::Scene::bounces_max) {
      file_.notes.push_back("the integrator's maxdepth is " + std::to_string(depth) + ", shown with " +
                            counted(static_cast<std::uint64_t>(*file_.bounces), "bounce"));
    }
    if (!has_row(name.text, kind)) {
      all.fail("there is no integrator of kind '" + clipped(kind, 40) + "' in pbrt-v4");
    }
    if (kind == "ambientocclusion" || kind == "function") {
      file_.notes.push_back("the integrator \"" + kind + "\" shows something else than light, shown by paths" +
                            (kind == "function" ? "" : "; --sky=1 --bounces=0 shows what is near much as it does"));
    }
    finish(all, name.text, kind);
  }

  void sampler(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "");
    constexpr std::int64_t most = 32768;
    const bool is_stratified = kind == "stratified";
    const auto count = [&](const char* side) { return std::clamp<std::int64_t>(all.integer(side, 4), 0, most); };
    const std::int64_t samples =
        is_stratified ? count("xsamples") * count("ysamples") : all.integer("pixelsamples", kind == "independent" ? 4 : 16);
    if (samples > 0) {
      file_.notes.push_back("the sampler takes " + counted(static_cast<std::uint64_t>(samples), "sample") +
                            " a pixel: --samples=" + std::to_string(std::min(samples, most)) + " does so, too");
    }
    finish(all, name.text, kind);
  }

  void option(const Token& name) {
    const Parameters all(tokens_, "Option", name.place);
    finish(all, name.text, "");
  }

  void medium_interface(const Token& name) {
    const std::string inside = text(name, "a medium's name");
    if (tokens_.peek().kind == TokenKind::text) {
      tokens_.next();
    }
    notes_.count("media, which are not shown", inside.empty() ? 0 : 1);
  }

  void world_begin(const Token& name) {
    if (std::exchange(is_world_, true)) {
      tokens_.fail(name.place, "WorldBegin is there a second time");
    }
    state_.ctm = {};
    state_.moves_start = true;
    systems_.insert_or_assign("world", state_.ctm);
  }

  void texture(const Token& name) {
    const std::string texture = text(name, "its name"), type = text(name, "what it is of"), kind = text(name, "its kind");
    const Parameters all = parameters(texture, name, "texture");
    const auto add = [this, texture, type, kind, all] {
      textures_.add(texture, type, kind, all);
      finish(all, "Texture", kind);
    };
    if (kind == "imagemap" || kind == "ptex") {
      add();
    } else {
      awaited_looks_[type == "float" ? 0 : 1].emplace_back(add);
    }
  }

  void material(const Token& name) {
    const std::string kind = text(name, "its kind");
    state_.surface = announced(std::nullopt, kind, parameters(kind, name, "material"));
  }

  void make_named_material(const Token& name) {
    const std::string material = text(name, "its name");
    const Parameters all = parameters(material, name, "material");
    announced(material, all.text("type", ""), all);
  }

  std::uint32_t announced(const std::optional<std::string>& material, const std::string& kind, const Parameters& all) {
    const std::uint32_t number = surfaces_.announce(material, kind, all);
    const auto make = [this, number, kind, all] {
      surfaces_.make(number, kind, all);
      finish(all, "Material", kind);
    };
    if (all.name_textures()) {
      awaited_looks_[2].emplace_back(make);
    } else {
      make();
    }
    return number;
  }

  void named_material(const Token& name) { state_.surface = surfaces_.named(text(name, "its name"), name.place); }

  void area_light(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "light");
    state_.light = area_light_of(kind, all, exposure(), notes_);
    finish(all, name.text, kind);
  }

  void light(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "light");
    add_light(kind, all, tokens_, state_.ctm, exposure(), file_, notes_);
    finish(all, name.text, kind);
  }

  void shape(const Token& name) {
    const std::string kind = text(name, "its kind");
    const Parameters all = parameters(kind, name, "shape");
    std::optional<PlacedShape> shape =
        shape_of(kind, all, tokens_, files_, notes_, !surfaces_.is_made(state_.surface));  // textured ones are made later
    if (shape) {
      add_shape(*std::move(shape), all);
      finish(all, name.text, kind);
    }
  }

  void include(const Token& name) { tokens_.include(text(name, "a file's name"), name.place); }

  void import(const Token& name) {
    save(Opening::import, name.place);
    include(name);
  }

  void of_older_versions(const Token& name) {
    tokens_.fail(
        name.place,
        name.text + " is a statement of pbrt-v3 and older versions: turn the scene into one of version 4 by pbrt --upgrade");
  }

  void save(Opening opening, const Place& place) {
    if (saved_.size() >= attribute_levels_max) {
      tokens_.fail(place,
                   "more than " + grouped(attribute_levels_max) + " of AttributeBegin and the like stand within each other");
    }
    saved_.push_back({state_, opening, place, tokens_.level()});
  }

  void restore(Opening opening, const Token& name) {
    if (saved_.empty() || saved_.back().opening != opening) {
      tokens_.fail(name.place, name.text + " ends what has not begun" +
                                   (saved_.empty() ? "" : ", within what begins at " + tokens_.text_of(saved_.back().place)));
    }
    state_ = std::move(saved_.back().state);
    saved_.pop_back();
  }

  /// The state set by an imported file ends with the file.
  void end_imports() {
    while (!saved_.empty() && saved_.back().opening == Opening::import && tokens_.level() <= saved_.back().file_level) {
      state_ = std::move(saved_.back().state);
      saved_.pop_back();
    }
  }

  /// Transforms that apply only at the end of the shutter time are ignored.
  void apply(const Token& name, const Transform& map) {
    if (state_.moves_start) {
      const Transform moved = composed(state_.ctm, map);
      check_map(name, moved);
      state_.ctm = moved;
    }
  }

  void check_map(const Token& name, const Transform& map) const {
    const auto is_usable = [](const Vec3d& row) { return core::largest_component(row) <= number_max && is_finite(row); };
    if (!is_usable(map.rows[0]) || !is_usable(map.rows[1]) || !is_usable(map.rows[2]) || !is_usable(map.shift)) {
      tokens_.fail(name.place, name.text + " puts what follows beyond 1e30");
    }
  }

  std::vector<double> numbers(const Token& name, std::size_t count) {
    const bool is_list = tokens_.peek().kind == TokenKind::open;
    if (is_list) {
      tokens_.next();
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      const Token token = tokens_.next();
      const auto value = token.kind == TokenKind::word ? decimal_number(token.text) : std::nullopt;
      if (!value || !(std::abs(*value) <= number_max)) {
        tokens_.fail(token.place, name.text + " has " + quoted(token.text) + " as number " + std::to_string(i + 1) +
                                      ", expected " + std::to_string(count) + " numbers, none beyond 1e30");
      }
      values.push_back(*value);
    }
    if (is_list) {
      if (const Token token = tokens_.next(); token.kind != TokenKind::close) {
        tokens_.fail(token.place,
                     name.text + " has " + quoted(token.text) + " where its list of " + std::to_string(count) + " numbers ends");
      }
    }
    return values;
  }

  std::string text(const Token& name, const char* what) {
    const Token token = tokens_.next();
    if (token.kind != TokenKind::text) {
      tokens_.fail(token.place, name.text + " is followed by " + quoted(token.text) + ", expected " + what + " in quotes");
    }
    return token.text;
  }

  /// Reads parameters, with the defaults of Attribute statements. finish() counts the unused ones by the parameter table.
  Parameters parameters(const std::string& owner, const Token& name, const char* kind) {
    Parameters result(tokens_, name.text + " " + quoted(owner), name.place);
    const auto defaults = state_.defaults.find(kind);
    if (defaults != state_.defaults.end()) {
      result.add_defaults(defaults->second);
    }
    return result;
  }

  void finish(const Parameters& parameters, const std::string& statement, const std::string& kind) {
    for (const std::string& name : parameters.unused()) {
      const ParameterFate fate = fate_of(statement, kind, name);
      if (fate == ParameterFate::said) {
        notes_.count("\"" + name + "\" of " + statement + (kind.empty() ? "" : " \"" + kind + "\"") + ", which is not shown");
      } else if (fate != ParameterFate::silent) {
        notes_.count("parameters \"" + clipped(name, 40) + "\" that mean nothing where they stand", 1);
      }
    }
  }

  Exposure exposure() const {
    Exposure exposure = film_.exposure;
    exposure.factor *= camera_.value_or(Camera{}).open_seconds;
    return exposure;
  }

  void add_shape(PlacedShape shape, const Parameters& parameters) {
    shape.is_turned = state_.is_reversed;
    shape.mesh.name = tokens_.text_of(parameters.place());
    set_look(shape, parameters);
    const GeometrySize copy = shape.size_of_copy();
    count({.bytes = sizeof(PlacedShape) + sizeof(ShapePlace) + shape.mesh.name.size()}, parameters.place());
    count(shape.round ? copy : size_of(shape.mesh), parameters.place());
    const ShapePlace place{static_cast<std::uint32_t>(file_.shapes.size()), state_.ctm};
    if (open_object_ != nullptr) {
      open_object_->places.push_back(place);
      open_object_->anew += files_.totals().size_of_place(copy);
    } else {
      file_.places.push_back(place);
      shape.uses = 1;
    }
    file_.shapes.push_back(std::move(shape));
  }

  /// Sets the material, and that of the back if only the front emits.
  void set_look(PlacedShape& shape, const Parameters& parameters) {
    Look look{.surface = state_.surface, .emission = {}, .opacity = 1};
    const bool is_cut = parameters.find("alpha", {ParameterType::texture}) != nullptr;
    notes_.count("shapes that a texture cuts out, shown whole", is_cut ? 1 : 0);
    look.opacity = std::clamp(parameters.number("alpha", 1), 0.0, 1.0);
    const std::size_t dark = look_number(look);
    shape.mesh.material = dark;
    if (!state_.light) {
      return;
    }
    if (open_object_ != nullptr) {
      notes_.count("area lights of objects with instances, which shine nowhere, as in pbrt");
      return;
    }
    if (look.opacity <= 0) {
      for (const FileLight& light : unseen_lights(*state_.light, shape, state_.ctm)) {
        unseen_.emplace_back(look.surface, light);
      }
      notes_.count("area lights that alpha takes away, which light as points");
      return;
    }
    look.emission = radiance_of(*state_.light, shape, state_.ctm);
    look.is_light = true;
    shape.mesh.material = look_number(look);
    if (!state_.light->is_twosided && !shape.is_ball() && look.emission != Vec3d{}) {
      shape.back = dark;
    }
  }

  std::size_t look_number(const Look& look) {
    const auto [found, is_new] = look_numbers_.try_emplace(look.key(), looks_.size());
    if (is_new) {
      looks_.push_back(look);
    }
    return found->second;
  }

  /// Adds to the scene's totals; a failure is reported at `said`.
  void count(const GeometrySize& more, const Place& said) {
    files_.totals().add(more, [&] { return tokens_.text_of(said) + ": "; });
  }

  void give_materials() {
    for (Look& look : looks_) {
      look.emission = surfaces_.at(look.surface).is_drawn ? look.emission : Vec3d{};
      file_.materials.push_back(Surfaces::material_of(surfaces_.at(look.surface), look.emission, look.opacity));
    }
  }

  /// Except for shapes with the material "interface".
  void add_unseen_lights() {
    for (const auto& [surface, light] : unseen_) {
      if (surfaces_.at(surface).is_drawn) {
        file_.lights.push_back(light);
      }
    }
  }

  /// Removes shapes that only separate media, which neither show nor emit anything, and shapes that alpha removes.
  void drop_undrawn() {
    const auto is_undrawn = [this](const ShapePlace& place) {
      const Look& look = looks_[file_.shapes[place.shape].mesh.material];
      return !surfaces_.at(look.surface).is_drawn || look.opacity <= 0;
    };
    const auto shines_nowhere = [this](const ShapePlace& place) {
      const Look& look = looks_[file_.shapes[place.shape].mesh.material];
      return look.is_light && !surfaces_.at(look.surface).is_drawn;
    };
    notes_.count("area lights of the material \"interface\", which shine nowhere, as in pbrt",
                 static_cast<std::uint64_t>(std::count_if(file_.places.begin(), file_.places.end(), shines_nowhere)));
    for (const ShapePlace& place : file_.places) {
      file_.shapes[place.shape].uses -= is_undrawn(place) ? 1 : 0;
    }
    const std::size_t before = file_.places.size();
    std::erase_if(file_.places, is_undrawn);
    notes_.count("shapes that only part media from each other, or that alpha takes away, left out", before - file_.places.size());
  }

  void check_ended() const {
    if (!saved_.empty()) {
      tokens_.fail(saved_.back().place, "what begins here is not ended");
    }
  }

  /// Transforms the scene into coordinates that our camera does not mirror.
  void turn_round(const Transform& turn) {
    for (ShapePlace& place : file_.places) {
      place.world = composed(turn, place.world);
    }
    for (FileLight& light : file_.lights) {
      light.position = turn.point(light.position);
      light.cone.ahead = turn.direction(light.cone.ahead);
    }
    for (FileSky& sky : file_.skies) {
      const Transform rows{sky.rows, {}};
      sky.rows = composed(rows, turn).rows;  // the transform is its own inverse
    }
  }

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

// Transforms.

// Graphics state.

// Objects.

// Camera and film.

// Materials and textures.

// Shapes.

}  // namespace

PlacedFile read_pbrt(const std::string& path, const MeshOptions& options, SceneFiles& files) {
  return Statements(path, files).read(options.size);
}

}  // namespace dmpc::apps::pbrt
