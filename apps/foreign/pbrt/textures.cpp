#include "apps/foreign/pbrt/textures.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>

#include "apps/frontend/line/shown_text.h"
#include "apps/picture/png_file.h"
#include "core/scene/texel.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;
using enum ParameterType;

constexpr std::uint32_t squares = 2, square_texels = 64;

std::uint32_t texel_of(const Vec3d& color) { return core::encoded(core::TexelFormat::srgb, color); }

MadePicture checks(const Vec3d& first, const Vec3d& second) {
  constexpr std::size_t side = squares * square_texels;
  const auto take = [of_first = texel_of(first), of_second = texel_of(second)](std::size_t pixel, std::span<std::uint8_t> rgb) {
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      const std::size_t x = (pixel + i / 3) % side, y = (pixel + i / 3) / side;
      const bool is_first = (x / square_texels + (side - 1 - y) / square_texels) % 2 == 0;
      rgb[i] = static_cast<std::uint8_t>((is_first ? of_first : of_second) >> 8 * (i % 3));
    }
  };
  const std::string png = png_file({.width = static_cast<int>(side), .height = static_cast<int>(side), .take = take}, 1);
  const auto bytes = std::as_bytes(std::span(png));
  return {.file = {bytes.begin(), bytes.end()}, .format_hint = "png"};
}

}  // namespace

void Textures::add(const std::string& name, const std::string& type, const std::string& kind, const Parameters& parameters) {
  if (type != "spectrum" && type != "float") {
    parameters.fail("a texture is of 'spectrum' or 'float', and this one of '" + clipped(type, 40) + "'");
  }
  const bool is_number = type == "float";
  auto& named = is_number ? numbers_ : colors_;
  if (!named.try_emplace(name, value_of(kind, parameters, is_number)).second) {
    parameters.fail("there is a texture of this name already");
  }
}

TextureValue Textures::value_of(const std::string& kind, const Parameters& parameters, bool is_number) {
  if (kind == "constant") {
    return part(parameters, "value", 1, is_number);
  }
  if (kind == "scale") {
    return scaled(parameters, is_number);
  }
  if (kind == "mix" || kind == "directionmix") {
    notes_.count("textures that mix by direction, shown half and half", kind == "directionmix" ? 1 : 0);
    return mixed(parameters, is_number);
  }
  if (kind == "checkerboard") {
    return checkered(parameters, is_number);
  }
  if (kind == "dots") {
    return dotted(parameters, is_number);
  }
  if (kind == "imagemap") {
    return pictured(parameters);
  }
  notes_.count("textures of kind '" + clipped(kind, 40) + "', shown as plain grey");
  return {.color = {number_of_picture, number_of_picture, number_of_picture}, .picture = {}, .place = {}};
}

const TextureValue& Textures::find(const Parameter& parameter, const Parameters& owner, bool is_number) const {
  const auto& named = is_number ? numbers_ : colors_;
  const std::string name = parameter.texts.empty() ? "" : parameter.texts[0];
  const auto found = named.find(name);
  if (found == named.end()) {
    owner.fail(parameter.place, "the texture \"" + clipped(name, 60) + "\" is not there: no Texture statement of " +
                                    (is_number ? "numbers" : "colours") +
                                    " has that name, or none before, where textures that are no pictures name each other");
  }
  return found->second;
}

TextureValue Textures::part(const Parameters& parameters, const char* name, double fallback, bool is_number) const {
  if (!is_number) {
    return color(parameters, name, {fallback, fallback, fallback}, SpectrumUse::reflectance);
  }
  const Parameter* const found = parameters.find(name, {texture, ParameterType::number});
  if (found != nullptr && found->type == texture) {
    return find(*found, parameters, true);
  }
  const double value = found == nullptr ? fallback : parameters.number(name, fallback);
  return {.color = {value, value, value}, .picture = {}, .place = {}};
}

TextureValue Textures::scaled(const Parameters& parameters, bool is_number) {
  TextureValue value = part(parameters, "tex", 1, is_number);
  const Parameter* const by_texture = parameters.find("scale", {texture});
  const TextureValue by = by_texture != nullptr ? find(*by_texture, parameters, numbers_.contains(by_texture->texts[0]))
                                                : part(parameters, "scale", 1, true);
  value.color = value.color * by.color;
  if (by.picture && value.picture) {
    notes_.count("products of two pictures, of which the first is shown alone");
  } else if (by.picture) {
    value.picture = by.picture;
    value.place = by.place;
  }
  return value;
}

TextureValue Textures::mixed(const Parameters& parameters, bool is_number) {
  const TextureValue first = part(parameters, "tex1", 0, is_number), second = part(parameters, "tex2", 1, is_number);
  const Parameter* const by_texture = parameters.find("amount", {texture});
  const TextureValue by = by_texture != nullptr ? find(*by_texture, parameters, true) : part(parameters, "amount", 0.5, true);
  const double amount = by.picture ? number_of_picture : std::clamp(by.color.x, 0.0, 1.0);
  if (!first.picture && !second.picture) {
    notes_.count("mixtures by a picture, shown half and half", by.picture ? 1 : 0);
    return {.color = first.color * (1 - amount) + second.color * amount, .picture = {}, .place = {}};
  }
  const bool is_one = amount <= 0 || amount >= 1;
  notes_.count("mixtures of pictures, of which the larger share is shown alone", is_one ? 0 : 1);
  return amount < 0.5 ? first : second;
}

/// Half of its cells have a dot, with a radius of 0.35 cells.
TextureValue Textures::dotted(const Parameters& parameters, bool is_number) {
  constexpr double share = 0.5 * 0.35 * 0.35 * std::numbers::pi;
  const TextureValue inside = part(parameters, "inside", 1, is_number), outside = part(parameters, "outside", 0, is_number);
  notes_.count("dots, shown as the mean of their colours");
  return {.color = inside.color * share + outside.color * (1 - share), .picture = {}, .place = {}};
}

TextureValue Textures::checkered(const Parameters& parameters, bool is_number) {
  const TextureValue first = part(parameters, "tex1", 1, is_number), second = part(parameters, "tex2", 0, is_number);
  const bool is_flat = parameters.integer("dimension", 2) == 2;
  if (first.picture || second.picture || !is_flat || is_number) {
    notes_.count("checkerboards of pictures or in space, shown as plain colour", is_number ? 0 : 1);
    return {.color = (first.picture ? second : first).color * 0.5 + (second.picture ? first : second).color * 0.5,
            .picture = {},
            .place = {}};
  }
  TextureValue value;
  value.picture = TextureUse{.path = "*" + std::to_string(pictures_.size()), .edges = {}};
  pictures_.push_back(checks(first.color, second.color));
  place(parameters, value, squares);
  return value;
}

/// Scales and shifts pbrt's u and v (v upwards); the picture covers `span` of the result, and its t increases downwards.
void Textures::place(const Parameters& parameters, TextureValue& value, double span) {
  const std::string mapping = parameters.text("mapping", "uv");
  notes_.count("textures that lie by a mapping of their own, shown by u and v", mapping == "uv" ? 0 : 1);
  const double su = parameters.number("uscale", 1), sv = parameters.number("vscale", 1), du = parameters.number("udelta", 0),
               dv = parameters.number("vdelta", 0);
  value.place.rows = {{{su / span, 0, du / span}, {0, sv / span, 1 - (sv + dv) / span}}};
}

TextureValue Textures::pictured(const Parameters& parameters) {
  TextureValue value;
  const std::string wrap = parameters.text("wrap", "repeat"), encoding = parameters.text("encoding", "sRGB");
  const core::TextureWrap edges = wrap == "repeat" ? core::TextureWrap::repeat : core::TextureWrap::clamp;
  const std::string path = parameters.text("filename", "");
  if (path.empty()) {
    parameters.fail("a texture of a picture has no filename");
  }
  value.picture = TextureUse{.path = path, .edges = {edges, edges}};
  const double scale = parameters.number("scale", 1);
  value.color = {scale, scale, scale};
  notes_.count("pictures that are black beyond their edges, shown with their edges going on", wrap == "black" ? 1 : 0);
  notes_.count("pictures that are to be inverted, shown as they are", parameters.flag("invert", false) ? 1 : 0);
  notes_.count("pictures whose encoding is not sRGB, shown as if it were", encoding == "sRGB" || encoding == "srgb" ? 0 : 1);
  place(parameters, value);
  return value;
}

std::optional<TextureValue> Textures::color(const Parameters& parameters, const char* name, SpectrumUse use) const {
  const Parameter* const found = parameters.find(name, {texture, rgb, spectrum, blackbody});
  if (found == nullptr) {
    return std::nullopt;
  }
  return found->type == texture ? find(*found, parameters, false)
                                : TextureValue{.color = color_of(*found, parameters, use), .picture = {}, .place = {}};
}

TextureValue Textures::color(const Parameters& parameters, const char* name, const Vec3d& fallback, SpectrumUse use) const {
  return color(parameters, name, use).value_or(TextureValue{.color = fallback, .picture = {}, .place = {}});
}

std::optional<double> Textures::number(const Parameters& parameters, const char* name) const {
  const Parameter* const found = parameters.find(name, {texture, ParameterType::number});
  if (found != nullptr && found->type == texture) {
    const TextureValue& value = find(*found, parameters, true);
    notes_.count("numbers by a picture, shown as if it were half grey all over", value.picture ? 1 : 0);
    return value.color.x * (value.picture ? number_of_picture : 1);
  }
  return parameters.number(name);
}

}  // namespace dmpc::apps::pbrt
