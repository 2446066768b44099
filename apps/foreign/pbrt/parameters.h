// The parameters of a statement: "type name" and a value, or a list in brackets.
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

/// All parameters of a statement. A lookup marks a parameter as used; unused parameters are counted.
class Parameters {
 public:
  /// Reads all parameters that follow. `owner`, such as `Shape "disk"`, is used in messages. `tokens` outlives this object.
  Parameters(Tokens& tokens, std::string owner, const Place& place);

  const Place& place() const { return place_; }
  /// Defaults that Attribute statements set for subsequent statements. Copies of a list share the parameters.
  using List = std::vector<std::shared_ptr<const Parameter>>;
  using Defaults = std::shared_ptr<const List>;
  void add_defaults(const Defaults& defaults) { defaults_ = defaults; }
  std::vector<Parameter> take_list() { return std::move(list_); }

  /// Returns the last parameter with this name and one of these types, or nullptr. A parameter of another type stays unused.
  const Parameter* find(std::string_view name, std::initializer_list<ParameterType> types) const;

  bool name_textures() const;

  /// Throw core::InputError, with the parameter's position, unless it has exactly one value.
  double number(std::string_view name, double fallback) const;
  std::optional<double> number(std::string_view name) const;
  std::int64_t integer(std::string_view name, std::int64_t fallback) const;
  bool flag(std::string_view name, bool fallback) const;
  std::string text(std::string_view name, const std::string& fallback) const;
  std::optional<core::Vec3d> point(std::string_view name) const;
  /// Returns points in single precision, as in pbrt. Throws core::InputError if the number of values is not a multiple of three.
  std::vector<core::Vec3d> points(std::string_view name, std::initializer_list<ParameterType> types) const;

  /// Throws core::InputError with the position of a parameter or of its statement.
  [[noreturn]] void fail(const Place& place, const std::string& what) const { tokens_.fail(place, owner_ + ": " + what); }
  [[noreturn]] void fail(const std::string& what) const { fail(place_, what); }

  /// Returns the names of parameters that were never looked up, unless another parameter of the same name was.
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

/// Groups all values into triples.
std::vector<core::Vec3d> triples(const std::vector<double>& numbers);

}  // namespace dmpc::apps::pbrt
