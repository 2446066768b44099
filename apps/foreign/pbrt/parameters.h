// What stands behind a statement's names: "type name" and a value, or a list in brackets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/pbrt/tokens.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

enum class ParameterType : std::uint8_t {
  number,
  integer,
  boolean,
  text,
  texture,
  point2,
  point3,
  vector2,
  vector3,
  normal,
  rgb,
  spectrum,
  blackbody,
};

struct Parameter {
  ParameterType type{};
  std::string name;
  Place place;
  std::vector<double> numbers;     ///< values other than text; booleans as 0 and 1
  std::vector<std::string> texts;  ///< strings, and names of textures and spectra
  mutable bool is_used = false;
};

/// All of a statement. Looking for one marks it as used; what nobody looks for is counted.
class Parameters {
 public:
  /// Reads as many as follow. `owner` is what they belong to, for messages: `Shape "disk"`. `tokens` outlives this.
  Parameters(Tokens& tokens, std::string owner, const Place& place);

  const Place& place() const { return place_; }
  /// What Attribute says of all such that follow, where they do not say it themselves. A list that has another's shares them.
  using List = std::vector<std::shared_ptr<const Parameter>>;
  using Defaults = std::shared_ptr<const List>;
  void add_defaults(const Defaults& defaults) { defaults_ = defaults; }
  std::vector<Parameter> take_list() { return std::move(list_); }

  /// The last parameter with this name and one of these types; nothing if there is none. A parameter of another type stays
  /// unused.
  const Parameter* find(std::string_view name, std::initializer_list<ParameterType> types) const;

  bool name_textures() const;

  /// Throw core::InputError at the parameter's place if it has not one value.
  double number(std::string_view name, double fallback) const;
  std::optional<double> number(std::string_view name) const;
  std::int64_t integer(std::string_view name, std::int64_t fallback) const;
  bool flag(std::string_view name, bool fallback) const;
  std::string text(std::string_view name, const std::string& fallback) const;
  std::optional<core::Vec3d> point(std::string_view name) const;
  /// In single precision, as pbrt keeps them. Throws core::InputError if their number is not a multiple of three.
  std::vector<core::Vec3d> points(std::string_view name, std::initializer_list<ParameterType> types) const;

  /// core::InputError at the place of a parameter, or of the statement, that names it.
  [[noreturn]] void fail(const Place& place, const std::string& what) const { tokens_.fail(place, owner_ + ": " + what); }
  [[noreturn]] void fail(const std::string& what) const { fail(place_, what); }

  /// Names of what nobody has looked for, nor for another parameter of that name.
  std::vector<std::string> unused() const;

 private:
  Parameter read(const Token& declaration);
  void read_value(Parameter& parameter, const Token& token) const;
  void check(const Parameter& parameter) const;
  const Parameter& one(const Parameter& parameter) const;

  Tokens& tokens_;
  std::string owner_;
  Place place_;
  std::vector<Parameter> list_;
  Defaults defaults_;
};

/// All of its letters, in steps of `width`.
std::vector<core::Vec3d> triples(const std::vector<double>& numbers);

}  // namespace dmpc::apps::pbrt
