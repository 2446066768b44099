#include "apps/foreign/pbrt/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "apps/foreign/pbrt/spectra.h"
#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"

namespace dmpc::apps::pbrt {
namespace {

using enum ParameterType;

struct TypeName {
  std::string_view name;
  ParameterType type;
};
constexpr std::array<TypeName, 13> type_names{{{"float", number},
                                               {"integer", integer},
                                               {"bool", boolean},
                                               {"string", text},
                                               {"texture", texture},
                                               {"point2", point2},
                                               {"point3", point3},
                                               {"vector2", vector2},
                                               {"vector3", vector3},
                                               {"normal", normal},
                                               {"rgb", rgb},
                                               {"spectrum", spectrum},
                                               {"blackbody", blackbody}}};
/// Types of pbrt-v3.
constexpr std::array<std::string_view, 5> old_types{"point", "vector", "color", "xyz", "point4"};

constexpr std::string_view blanks = " \t\r\v\f";

/// Numbers per value.
std::size_t width_of(ParameterType type) {
  return type == point2 || type == vector2 ? 2 : type == point3 || type == vector3 || type == normal || type == rgb ? 3 : 1;
}

std::string_view without_blanks(std::string_view words) {
  const std::size_t first = std::min(words.find_first_not_of(blanks), words.size());
  return words.substr(first, words.find_last_not_of(blanks) + 1 - std::min(first, words.find_last_not_of(blanks) + 1));
}

/// Numbers beyond the range of floats are unchanged.
double in_single_precision(double number) {
  return std::fabs(number) <= double{std::numeric_limits<float>::max()} ? double{static_cast<float>(number)} : number;
}

}  // namespace

std::vector<core::Vec3d> triples(const std::vector<double>& numbers) {
  std::vector<core::Vec3d> result;
  result.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    result.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return result;
}

Parameters::Parameters(Tokens& tokens, std::string owner, const Place& place)
    : tokens_(tokens), owner_(std::move(owner)), place_(place) {
  while (tokens_.peek().kind == TokenKind::text) {
    list_.push_back(read(tokens_.next()));
  }
}

Parameter Parameters::read(const Token& declaration) {
  const std::string_view words = without_blanks(declaration.text);
  const std::size_t end = std::min(words.find_first_of(blanks), words.size());
  const std::string_view type = words.substr(0, end), name = without_blanks(words.substr(end));
  const auto known = std::find_if(type_names.begin(), type_names.end(), [&](const TypeName& one) { return one.name == type; });
  if (known == type_names.end() || name.empty()) {
    const bool is_old = std::find(old_types.begin(), old_types.end(), type) != old_types.end();
    fail(declaration.place, "\"" + clipped(declaration.text, 60) + "\" is no type and name of a parameter" +
                                (is_old ? ", but for pbrt-v3: turn the scene into one of version 4 by pbrt --upgrade"
                                        : "; expected such as \"float radius\""));
  }
  Parameter parameter{.type = known->type, .name = std::string(name), .place = declaration.place, .numbers = {}, .texts = {}};
  Token token = tokens_.next();
  if (token.kind != TokenKind::open) {
    read_value(parameter, token);
  } else {
    for (token = tokens_.next(); token.kind != TokenKind::close; token = tokens_.next()) {
      read_value(parameter, token);
    }
  }
  check(parameter);
  if (parameter.type == spectrum && parameter.texts.size() == 1 && !is_named_spectrum(parameter.texts[0])) {
    parameter.numbers = tokens_.numbers_of(parameter.texts[0], parameter.place);
    parameter.texts.clear();
    check(parameter);
  }
  return parameter;
}

void Parameters::read_value(Parameter& parameter, const Token& token) const {
  const bool is_of_text = parameter.type == ParameterType::text || parameter.type == texture;
  const auto what = [&parameter] { return "parameter \"" + clipped(parameter.name, 40) + "\""; };  // only for errors
  if (token.kind == TokenKind::end) {
    fail(parameter.place, what() + " is not ended");
  }
  if (token.kind == TokenKind::text && (is_of_text || parameter.type == spectrum)) {
    parameter.texts.push_back(token.text);
    return;
  }
  if (parameter.type == boolean && (token.text == "true" || token.text == "false")) {
    parameter.numbers.push_back(token.text == "true" ? 1 : 0);
    return;
  }
  const auto value = token.kind == TokenKind::word ? decimal_number(token.text) : std::nullopt;
  if (is_of_text || parameter.type == boolean || !value) {
    const char* const expected = is_of_text ? "a string in quotes" : parameter.type == boolean ? "true or false" : "a number";
    const std::string found = token.kind == TokenKind::open    ? "["
                              : token.kind == TokenKind::close ? "]"
                                                               : clipped(token.text, 40);
    fail(token.place, what() + " has '" + found + "', expected " + expected);
  }
  const double number = value.value_or(0);
  if (parameter.type == ParameterType::integer && std::trunc(number) != number) {
    fail(token.place, what() + " has " + clipped(token.text, 40) + ", expected a whole number");
  }
  parameter.numbers.push_back(number);
}

void Parameters::check(const Parameter& parameter) const {
  const std::string what = "parameter \"" + clipped(parameter.name, 40) + "\"";
  if (parameter.numbers.empty() && parameter.texts.empty()) {
    fail(parameter.place, what + " has no value");
  }
  const std::size_t width = width_of(parameter.type);
  if (parameter.numbers.size() % width != 0) {
    fail(parameter.place,
         what + " has " + grouped(parameter.numbers.size()) + " numbers, expected " + std::to_string(width) + " for each value");
  }
  if (parameter.type == spectrum &&
      (parameter.numbers.size() % 2 != 0 || (!parameter.texts.empty() && !parameter.numbers.empty()))) {
    fail(parameter.place, what + " is a spectrum that is neither a name nor pairs of wavelength and value");
  }
}

const Parameter* Parameters::find(std::string_view name, std::initializer_list<ParameterType> types) const {
  const auto is_it = [&](const Parameter& one) {
    return one.name == name && std::find(types.begin(), types.end(), one.type) != types.end();
  };
  const auto own = std::find_if(list_.rbegin(), list_.rend(), is_it);
  const Parameter* found = own == list_.rend() ? nullptr : &*own;
  if (found == nullptr && defaults_) {
    const auto known = std::find_if(defaults_->rbegin(), defaults_->rend(), [&](const auto& one) { return is_it(*one); });
    found = known == defaults_->rend() ? nullptr : known->get();
  }
  if (found != nullptr) {
    found->is_used = true;
  }
  return found;
}

const Parameter& Parameters::one(const Parameter& parameter) const {
  const std::size_t count = parameter.numbers.size() / width_of(parameter.type) + parameter.texts.size();
  if (count != 1) {
    fail(parameter.place, "parameter \"" + clipped(parameter.name, 40) + "\" has " + grouped(count) + " values, expected one");
  }
  return parameter;
}

std::optional<double> Parameters::number(std::string_view name) const {
  const Parameter* const found = find(name, {ParameterType::number});
  return found == nullptr ? std::nullopt : std::optional(one(*found).numbers[0]);
}

double Parameters::number(std::string_view name, double fallback) const { return number(name).value_or(fallback); }

std::int64_t Parameters::integer(std::string_view name, std::int64_t fallback) const {
  constexpr double most = 0x1p53;
  const Parameter* const found = find(name, {ParameterType::integer});
  if (found == nullptr) {
    return fallback;
  }
  if (!(std::abs(one(*found).numbers[0]) <= most)) {
    fail(found->place, "parameter \"" + clipped(found->name, 40) + "\" is beyond 2^53");
  }
  return static_cast<std::int64_t>(found->numbers[0]);
}

bool Parameters::flag(std::string_view name, bool fallback) const {
  const Parameter* const found = find(name, {boolean});
  return found == nullptr ? fallback : one(*found).numbers[0] != 0;
}

std::string Parameters::text(std::string_view name, const std::string& fallback) const {
  const Parameter* const found = find(name, {ParameterType::text});
  return found == nullptr ? fallback : one(*found).texts[0];
}

std::optional<core::Vec3d> Parameters::point(std::string_view name) const {
  const Parameter* const found = find(name, {point3, vector3});
  return found == nullptr ? std::nullopt : std::optional(triples(one(*found).numbers)[0]);
}

std::vector<core::Vec3d> Parameters::points(std::string_view name, std::initializer_list<ParameterType> types) const {
  const Parameter* const found = find(name, types);
  if (found == nullptr) {
    return {};
  }
  std::vector<core::Vec3d> points = triples(found->numbers);
  for (core::Vec3d& point : points) {
    point = {in_single_precision(point.x), in_single_precision(point.y), in_single_precision(point.z)};
  }
  return points;
}

bool Parameters::name_textures() const {
  const auto is_one = [](const Parameter& one) { return one.type == texture; };
  const auto points_to_one = [&](const auto& one) { return is_one(*one); };
  return std::ranges::any_of(list_, is_one) || (defaults_ && std::ranges::any_of(*defaults_, points_to_one));
}

std::vector<std::string> Parameters::unused() const {
  std::vector<std::string> names;
  for (const Parameter& parameter : list_) {
    const auto says_it = [&](const Parameter& one) { return one.is_used && one.name == parameter.name; };
    if (std::none_of(list_.begin(), list_.end(), says_it)) {
      names.push_back(parameter.name);
    }
  }
  return names;
}

}  // namespace dmpc::apps::pbrt
