#include "apps/foreign/obj/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/obj/unknown_words.h"
#include "apps/foreign/text/line_words.h"
#include "apps/foreign/text/text_lines.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/small_letters.h"

namespace dmpc::apps::obj {
namespace {

using core::Vec3d;

double in_unit(double value) { return std::clamp(value, 0.0, 1.0); }
Vec3d in_unit(const Vec3d& v) { return {in_unit(v.x), in_unit(v.y), in_unit(v.z)}; }

/// Longer than any file name.
constexpr std::size_t name_bytes_max = 4096;

/// Keywords that do not affect our pictures, or cannot be combined with those that are read.
constexpr std::array<std::string_view, 8> passed_over{"ka",    "sharpness", "ps",      "pcr",
                                                      "aniso", "anisor",    "map_aat", "ke_intensity"};

bool is_texture(const std::string& keyword) {
  return (keyword.starts_with("map_") && keyword != "map_aat") || keyword == "bump" || keyword == "disp" || keyword == "norm" ||
         keyword == "decal" || keyword == "refl";
}

class MtlParser {
 public:
  MtlParser(const std::function<void(MtlMaterial)>& take, std::vector<std::string>& notes) : take_(take), notes_(notes) {}

  void read(std::string_view file) {
    for (TextLines lines(file); lines.next();) {
      LineWords words(lines.line(), lines.number());
      const std::string keyword = in_small_letters(words.next());
      if (!keyword.empty()) {
        statement(keyword, words);
      }
    }
    finish();
    if (nameless_ > 0) {
      notes_.push_back("map_Kd names no file in line " + std::to_string(first_nameless_) +
                       (nameless_ == 1 ? "" : " and " + std::to_string(nameless_ - 1) + " others") +
                       ": there the plain colour is shown");
    }
    unknown_.note("unknown statements left out", notes_);
  }

 private:
  void statement(const std::string& keyword, LineWords& words) {
    if (keyword == "newmtl") {
      return begin(words);
    }
    if (!material_) {
      words.fail("expected 'newmtl NAME' before '" + clipped(keyword, 60) + "'");
    }
    if (is_texture(keyword)) {
      return texture(keyword, words);
    }
    const bool is_known =
        value_statement(keyword, words) || std::find(passed_over.begin(), passed_over.end(), keyword) != passed_over.end();
    if (!is_known) {
      unknown_.add(keyword, words.line());
    }
  }

  /// Returns whether the statement sets a colour or a number.
  bool value_statement(const std::string& keyword, LineWords& rest) {
    using Statement = void (*)(MtlMaterial & material, MtlParser & parser, LineWords & words);
    static const std::map<std::string_view, Statement> statements = {
        {"kd", [](auto& material, auto& parser, auto& words) { material.diffuse = parser.color(words); }},
        {"ks", [](auto& material, auto& parser, auto& words) { material.specular = parser.color(words).value_or(Vec3d{}); }},
        {"ke", [](auto& material, auto& parser, auto& words) { material.emission = parser.color(words).value_or(Vec3d{}); }},
        {"tf", [](auto& material, auto& parser, auto& words) { material.filter = parser.color(words); }},
        {"ns", [](auto& material, auto&, auto& words) { material.shine = number(words); }},
        {"ni", [](auto& material, auto&, auto& words) { material.refraction_index = number(words); }},
        {"d", [](auto& material, auto& parser, auto& words) { material.d = parser.opacity(words); }},
        {"tr", [](auto& material, auto&, auto& words) { material.transparency = number(words); }},
        {"illum", [](auto& material, auto&,
                     auto& words) { material.illumination = static_cast<int>(std::clamp(number(words), -1.0, 11.0)); }},
        {"pr", [](auto& material, auto&, auto& words) { material.roughness = number(words); }},
        {"pm", [](auto& material, auto&, auto& words) { material.metallic = number(words); }},
        {"pc", [](auto& material, auto&, auto& words) { material.has_clear_coat = number(words) > 0; }}};
    const auto found = statements.find(keyword);
    if (found != statements.end()) {
      found->second(*material_, *this, rest);
    }
    return found != statements.end();
  }

  void texture(const std::string& keyword, LineWords& words) {
    TextureWords said = texture_words(words.rest_of_line());
    if (said.name.size() > name_bytes_max) {
      words.fail("the name of a texture has " + grouped(said.name.size()) + " bytes, and no file's has more than " +
                 grouped(name_bytes_max));
    }
    if (keyword != "map_kd") {
      if (!said.name.empty()) {
        material_->other_textures.insert(said.name);
        material_->has_light_texture = material_->has_light_texture || keyword == "map_ke";
      }
    } else if (without_remark(said.name).empty()) {
      first_nameless_ = nameless_++ == 0 ? words.line() : first_nameless_;
    } else {
      material_->texture = std::move(said);
    }
  }

  void begin(LineWords& words) {
    finish();
    material_.emplace();
    material_->name = words.rest_of_line();
  }

  void finish() {
    if (material_) {
      take_(*std::exchange(material_, std::nullopt));
    }
  }

  /// A single number sets all three channels. Returns nothing for spectral curves or CIE XYZ.
  std::optional<Vec3d> color(LineWords& words) {
    LineWords ahead = words;
    const std::string_view first = ahead.next();
    if (first == "spectral" || first == "xyz") {
      material_->has_other_colors = true;
      return std::nullopt;
    }
    Vec3d color;
    color.x = color.y = color.z = words.number();
    if (words.has_next()) {
      color.y = words.number();
      color.z = words.number();
      words.expect_end();
    }
    return color;
  }

  double opacity(LineWords& words) {
    LineWords ahead = words;
    material_->has_halo = ahead.next() == "-halo";
    words = material_->has_halo ? ahead : words;
    return number(words);
  }

  static double number(LineWords& words) {
    const double value = words.number();
    words.expect_end();
    return value;
  }

  const std::function<void(MtlMaterial)>& take_;
  std::vector<std::string>& notes_;
  std::optional<MtlMaterial> material_;
  std::size_t nameless_ = 0, first_nameless_ = 0;  ///< number of textures without a name, and the line of the first
  UnknownWords unknown_;
};

}  // namespace

bool lacks_exponent(const MtlMaterial& material) {
  return !(material.roughness || material.metallic) && !(in_unit(material.specular) == Vec3d{}) && material.shine <= 0 &&
         material.illumination.value_or(2) == 2;
}

double opacity_of(const MtlMaterial& material) {
  return in_unit(material.d ? *material.d : 1 - material.transparency.value_or(0));
}

bool contradicts_itself(const MtlMaterial& material) {
  constexpr double rounding = 0.01;
  return material.d && material.transparency && std::abs(*material.d + *material.transparency - 1) > rounding;
}

Vec3d emission_of(const MtlMaterial& material) {
  const auto clamped = [](double channel) { return std::max(channel, 0.0); };
  const Vec3d& light = material.emission;
  return material.has_light_texture ? Vec3d{} : Vec3d{clamped(light.x), clamped(light.y), clamped(light.z)};
}

core::Material shown_material(const MtlMaterial& material) {
  const Vec3d diffuse = in_unit(material.diffuse.value_or(Vec3d{plain_grey, plain_grey, plain_grey}));
  if (material.roughness || material.metallic) {
    return material_of(MetallicSurface{.base = diffuse,
                                       .emission = emission_of(material),
                                       .metallic = in_unit(material.metallic.value_or(0)),
                                       .roughness = in_unit(material.roughness.value_or(1)),
                                       .refraction_index = material.refraction_index,
                                       .opacity = opacity_of(material)});
  }
  return material_of(PhongSurface{.diffuse = diffuse,
                                  .specular = in_unit(material.specular),
                                  .emission = emission_of(material),
                                  .shine = material.shine,
                                  .refraction_index = material.refraction_index,
                                  .opacity = opacity_of(material),
                                  .illumination = material.illumination});
}

void parse_mtl(std::string_view file, const std::function<void(MtlMaterial)>& take, std::vector<std::string>& notes) {
  MtlParser(take, notes).read(file);
}

}  // namespace dmpc::apps::obj
