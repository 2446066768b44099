#include "apps/lab/figures/figures_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/frontend/line/json_format.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

/// Deeper than any file of ours, and small enough for a recursive function.
constexpr int depth_max = 32;

Json parse_json(std::string_view text, const std::string& file) {
  try {
    return Json::parse(text, [&file](int depth, Json::parse_event_t, const Json&) {
      if (depth > depth_max) {
        throw core::InputError(file + ": expected at most " + std::to_string(depth_max) + " objects in each other");
      }
      return true;
    });
  } catch (const Json::exception&) {
    throw core::InputError(file + ": this is no JSON; expected what dmpc render --stats writes");
  }
}

FigureValue value_of(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return json.get<bool>();
    case Json::value_t::number_unsigned:
      return json.get<std::uint64_t>();
    case Json::value_t::number_integer:
    case Json::value_t::number_float:
      return json.get<double>();
    case Json::value_t::string:
      return json.get<std::string>();
    default:
      return std::monostate();
  }
}

void add_figures(const Json& json, const std::string& name, std::vector<Figure>& figures) {
  if (!json.is_structured()) {
    figures.push_back({name, value_of(json)});
    return;
  }
  std::size_t place = 0;
  for (const auto& [key, value] : json.items()) {
    const std::string last = json.is_array() ? std::to_string(place++) : key;
    add_figures(value, name.empty() ? last : name + "." + last, figures);
  }
}

struct ValueText {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::uint64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return shortest(value); }
  std::string operator()(const std::string& value) const { return value; }
};

/// Takes the word before the next dot, and removes the dot.
std::string_view take_word(std::string_view& words) {
  const std::size_t dot = words.find('.');
  const std::string_view word = words.substr(0, dot);
  words = dot == std::string_view::npos ? std::string_view() : words.substr(dot + 1);
  return word;
}

}  // namespace

std::vector<Figure> parse_figures(std::string_view text, const std::string& file) {
  const Json json = parse_json(text, file);
  const bool has_format = json.is_object() && json.contains("format");
  if (!has_format || json["format"] != json_format) {
    throw core::InputError(file + ": expected \"format\": " + std::to_string(json_format) + ", as dmpc render --stats writes it" +
                           (has_format ? ", got " + json["format"].dump(-1, ' ', true).substr(0, 40) : ", and there is none"));
  }
  std::vector<Figure> figures;
  add_figures(json, "", figures);
  if (json.contains("film_hash") && !json.contains("film_scale")) {
    figures.push_back({"film_scale", 1.0});  // films of older versions of dmpc had no other scale
  }
  return figures;
}

std::vector<Figure> read_figures(const std::filesystem::path& file) {
  return parse_figures(bounded_text(file, figures_bytes_max, "what dmpc render --stats writes"), file.string());
}

std::string text_of(const FigureValue& value) { return std::visit(ValueText{}, value); }

bool is_within(std::string_view name, std::string_view key) {
  while (!key.empty()) {
    const std::string_view wanted = take_word(key), word = take_word(name);
    if (word.empty() || (wanted != "*" && wanted != word)) {
      return false;
    }
  }
  return true;
}

std::optional<double> number_of(const FigureValue& value) {
  const auto* const whole = std::get_if<std::uint64_t>(&value);
  const auto* const real = std::get_if<double>(&value);
  return whole != nullptr ? std::optional(static_cast<double>(*whole)) : real != nullptr ? std::optional(*real) : std::nullopt;
}

}  // namespace dmpc::apps
