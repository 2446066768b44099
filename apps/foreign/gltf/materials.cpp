#include "apps/foreign/gltf/materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/surface.h"
#include "core/base/elementary.h"

namespace dmpc::apps::gltf {
namespace {

using core::Vec3d;

/// A member that refers to a texture is called so: "normalTexture".
bool is_texture(const std::string& key) { return key.ends_with("Texture"); }

core::TextureWrap edge_mode(const Part& sampler, const std::string& key) {
  const std::uint64_t mode = sampler.whole(key, 10497);
  if (mode != 10497 && mode != 33071 && mode != 33648) {
    sampler.get(key).fail("is " + std::to_string(mode) + ", expected 10497, 33071 or 33648");
  }
  return mode == 33071 ? core::TextureWrap::clamp : mode == 33648 ? core::TextureWrap::mirror : core::TextureWrap::repeat;
}

/// The transform of KHR_texture_transform: scaled, then turned, then moved.
TexturePlace transformed(const Part& transform) {
  const double angle = transform.number("rotation", 0);
  const std::vector<double> offset = transform.numbers("offset", {0, 0}), scale = transform.numbers("scale", {1, 1});
  if (!(std::abs(angle) <= 1e6)) {
    transform.get("rotation").fail("expected radians of at most 1e6 in magnitude");
  }
  const double sine = core::sin_radians(angle), cosine = core::cos_radians(angle);
  return {{{{cosine * scale[0], sine * scale[1], offset[0]}, {-sine * scale[0], cosine * scale[1], offset[1]}}}};
}

/// Which coordinates a texture lies by, and how they are transformed.
struct TextureLayout {
  std::uint64_t coordinates = 0;
  TexturePlace place;

  bool operator==(const TextureLayout&) const = default;
};

TextureLayout layout_of(const Part& use) {
  const std::uint64_t plain = use.whole("texCoord", 0);
  const auto transform = use.extension("KHR_texture_transform");
  return {transform ? transform->whole("texCoord", plain) : plain, transform ? transformed(*transform) : TexturePlace{}};
}

/// What is known of materials of specular and glossiness, which came before those of metal and roughness: their colour and their
/// roughness. So they are no metals.
struct Base {
  Part colours, roughness;
  const char *color, *texture;
  const char* facets;  ///< what calls its texture of metal and roughness, if one may say of them
  bool is_glossy;
};

Base base_of(const Part& source, const Part& empty) {
  if (const auto glossy = source.extension("KHR_materials_pbrSpecularGlossiness")) {
    return {*glossy, *glossy, "diffuseFactor", "diffuseTexture", "", true};
  }
  const Part base = source.find("pbrMetallicRoughness").value_or(empty);
  return {base, base, "baseColorFactor", "baseColorTexture", "metallicRoughnessTexture", false};
}

std::string alpha_mode(const Part& source) { return source.choice("alphaMode", {"OPAQUE", "MASK", "BLEND"}, "OPAQUE"); }

/// Numbers of a material, of which those outside of what they may be are brought into it.
class Factors {
 public:
  double share(double value) { return within(value, 1); }
  Vec3d color(const std::vector<double>& channels, double most = 1) {
    return {within(channels[0], most), within(channels[1], most), within(channels[2], most)};
  }
  bool are_beyond() const { return are_beyond_; }

 private:
  double within(double value, double most) {
    constexpr double rounding = 1e-5;
    are_beyond_ = are_beyond_ || value < -rounding || value > most + rounding;
    return std::clamp(value, 0.0, most);
  }

  bool are_beyond_ = false;
};

/// How files of this kind end, by what the bytes begin with: what a document says of them need not be true.
std::string ending_of(const std::vector<std::byte>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto begins = [&](std::string_view beginning) { return text.starts_with(beginning); };
  return begins("\xff\xd8\xff")                                 ? "jpg"
         : begins("RIFF") && text.substr(8).starts_with("WEBP") ? "webp"
         : begins("\xabKTX")                                    ? "ktx2"
         : begins("GIF8")                                       ? "gif"
         : begins("BM")                                         ? "bmp"
                                                                : "png";
}

class MaterialReader {
 public:
  MaterialReader(const Document& document, Buffers& buffers, SceneTotals& totals, PlacedFile& file)
      : root_(document.root()),
        textures_(root_.list("textures")),
        samplers_(root_.list("samplers")),
        images_(root_.list("images")),
        buffers_(buffers),
        totals_(totals),
        file_(file) {}

  void add(const Part& source, MaterialTraits& traits) {
    static const nlohmann::json nothing = nlohmann::json::object();
    const Base base = base_of(source, Part(nothing));
    FileMaterial& material = file_.materials.emplace_back();
    source.text("name", "");  // which nobody shows, and which is no name if it is no text
    add_others(source, base, traits);
    material.material = surface_of(source, base, traits);
    set_alpha(source, std::clamp(base.colours.numbers(base.color, {1, 1, 1, 1})[3], 0.0, 1.0), material);
    add_textures(base, material, traits);
  }

  /// How often a texture was named that names no picture.
  std::uint64_t without_picture() const { return without_picture_; }

 private:
  core::Material surface_of(const Part& source, const Base& base, MaterialTraits& traits) {
    const std::vector<double> color = base.colours.numbers(base.color, {1, 1, 1, 1});
    std::vector<double> light = source.numbers("emissiveFactor", {0, 0, 0});
    const auto stronger = source.extension("KHR_materials_emissive_strength"), ior = source.extension("KHR_materials_ior"),
               transmission = source.extension("KHR_materials_transmission"), coat = source.extension("KHR_materials_clearcoat");
    for (double& channel : light) {
      channel *= stronger ? stronger->number("emissiveStrength", 1) : 1;
    }
    Factors factors;
    const double opacity = factors.share(color[3]);
    MetallicSurface surface{
        .base = factors.color(color), .emission = factors.color(light, std::numeric_limits<double>::max()), .metallic = 0};
    if (base.is_glossy) {
      surface.roughness = factors.share(1 - base.roughness.number("glossinessFactor", 1));
    } else {
      surface.metallic = factors.share(base.roughness.number("metallicFactor", 1));
      surface.roughness = factors.share(base.roughness.number("roughnessFactor", 1));
    }
    surface.transmission = transmission ? factors.share(transmission->number("transmissionFactor", 0)) : 0;
    surface.refraction_index = ior ? ior->number("ior", 1.5) : 1.5;
    surface.opacity = alpha_mode(source) == "BLEND" ? opacity : 1;
    traits.has_light_texture = traits.has_light_texture && surface.emission != Vec3d{};
    surface.emission = traits.has_light_texture ? Vec3d{} : surface.emission;
    traits.colors_what_shines_through =
        surface.transmission > 0 && !(surface.base.x == surface.base.y && surface.base.y == surface.base.z);
    traits.has_clear_coat = coat && coat->number("clearcoatFactor", 0) > 0;
    traits.has_factor_beyond = factors.are_beyond();
    return material_of(surface);
  }

  /// What a texture's alpha does, by which the material's `own` is multiplied.
  void set_alpha(const Part& source, double own, FileMaterial& material) {
    const std::string mode = alpha_mode(source);
    const double cutoff = source.number("alphaCutoff", 0.5);
    if (mode == "BLEND") {
      material.material.alpha = core::AlphaUse::blend;
    } else if (mode == "MASK" && cutoff > 0 && cutoff <= own) {
      material.material.alpha = core::AlphaUse::cut;
      material.material.alpha_cutoff = cutoff / own;
    }
    material.is_cut_away = mode == "MASK" && own < cutoff;
  }

  void add_textures(const Base& base, FileMaterial& material, MaterialTraits& traits) {
    const auto color = base.colours.find(base.texture), facets = base.roughness.find(base.facets);
    const TextureLayout layout = color ? layout_of(*color) : TextureLayout{};
    if (color) {
      material.texture = texture_use(*color);
      material.place = layout.place;
    }
    if (material.texture) {
      traits.coordinates = layout.coordinates;
      material.texture->edges.alpha =
          material.material.alpha != core::AlphaUse::none ? TextureAlpha::kept : TextureAlpha::ignored;
      material.texture->edges.cutoff = material.material.alpha_cutoff;
    }
    if (facets) {
      material.facets = texture_use(*facets);
      material.lie_facets_there = layout_of(*facets) == layout;
    }
  }

  /// All but those of the colour and of what `base` says of metal, at any depth that makes sense.
  void add_others(const Part& source, const Base& base, MaterialTraits& traits, int level = 0) {
    constexpr int levels_max = 16;
    if (level > levels_max) {
      source.fail("extensions within each other more than 16 deep, expected one or two");
    }
    for (const auto& [key, part] : source.members()) {
      if (key == "baseColorTexture" || key == "diffuseTexture" || key == base.facets) {
        continue;
      }
      if (is_texture(key)) {
        const auto image = image_of(part);
        if (image) {
          traits.other_textures.insert(*image);
        }
        traits.has_light_texture = traits.has_light_texture || (key == "emissiveTexture" && image);
      } else if (key == "extensions" || key == "pbrMetallicRoughness" || key.starts_with("KHR_")) {
        add_others(part, base, traits, level + 1);
      }
    }
  }

  const Part& texture_of(const Part& use) const { return textures_[use.required_index("index", textures_.size(), "textures")]; }

  std::optional<std::size_t> image_of(const Part& use) {
    const Part& texture = texture_of(use);
    std::optional<std::size_t> image = texture.index("source", images_.size(), "images");
    for (const char* const format : {"EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds", "KHR_texture_basisu"}) {
      const auto other = texture.extension(format);
      if (other && !texture.find("source")) {
        image = other->index("source", images_.size(), "images");
        break;
      }
    }
    without_picture_ += image ? 0 : 1;
    return image;
  }

  std::optional<TextureUse> texture_use(const Part& use) {
    const auto image = image_of(use);
    if (!image) {
      return std::nullopt;
    }
    TextureUse result{.path = name_of(*image), .edges = {}};
    if (const auto sampler = texture_of(use).index("sampler", samplers_.size(), "samplers")) {
      result.edges.s = edge_mode(samplers_[*sampler], "wrapS");
      result.edges.t = edge_mode(samplers_[*sampler], "wrapT");
    }
    return result;
  }

  /// What a texture calls it: the name of a file, or, of one within the document, its number behind a star.
  std::string name_of(std::size_t image) {
    const Part& part = images_[image];
    const std::string address = part.text("uri", "");
    if (!address.empty() && !is_data(address)) {
      return address;
    }
    const auto [known, is_new] = numbers_.try_emplace(image, file_.pictures.size());
    if (is_new) {
      MadePicture& picture = file_.pictures.emplace_back();
      if (address.empty()) {
        const auto view = buffers_.view(part.required_index("bufferView", buffers_.view_count(), "bufferViews")).bytes;
        totals_.add({.bytes = view.size()}, [&part] { return part.where() + ": "; });  // as others may name the same bytes
        picture.file.assign(view.begin(), view.end());
      } else {
        picture.file = bytes_of_data(address, part);
      }
      if (picture.file.size() > std::numeric_limits<std::uint32_t>::max()) {
        part.fail("is larger than 4 GiB");
      }
      picture.format_hint = ending_of(picture.file);
    }
    return "*" + std::to_string(known->second);
  }

  Part root_;
  std::vector<Part> textures_, samplers_, images_;
  Buffers& buffers_;
  SceneTotals& totals_;
  PlacedFile& file_;
  std::map<std::size_t, std::size_t> numbers_;  ///< images within the document -> the file's pictures
  std::uint64_t without_picture_ = 0;
};

}  // namespace

std::vector<MaterialTraits> read_materials(const Document& document, Buffers& buffers, SceneTotals& totals, PlacedFile& file) {
  static const nlohmann::json nothing = nlohmann::json::object();
  std::vector<Part> sources = document.root().list("materials");
  sources.emplace_back(nothing);
  MaterialReader reader(document, buffers, totals, file);
  std::vector<MaterialTraits> traits(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    reader.add(sources[i], traits[i]);
  }
  note_count(file.notes, "textures that name no picture, left out", reader.without_picture());
  return traits;
}

void note_losses(const std::vector<MaterialTraits>& materials, const std::vector<bool>& used, PlacedFile& file) {
  const auto note = [&](const std::string& what, const auto& has_one) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
      count += used[i] && has_one(i) ? 1 : 0;
    }
    note_count(file.notes, what, count);
  };
  std::set<std::uint64_t> textures;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) {
      textures.insert(materials[i].other_textures.begin(), materials[i].other_textures.end());
    }
  }
  note_count(file.notes, "textures not used, since they are not of a surface's colour", textures.size());
  note("materials whose own light is a texture's, shown without it",
       [&](std::size_t i) { return materials[i].has_light_texture; });
  note("materials that colour what shines through them, shown without that",
       [&](std::size_t i) { return materials[i].colors_what_shines_through; });
  note("materials cut away altogether by their alpha, whose faces are left out",
       [&](std::size_t i) { return file.materials[i].is_cut_away; });
  note("materials with a clear coat, shown without it", [&](std::size_t i) { return materials[i].has_clear_coat; });
  note("materials with factors outside 0 to 1, brought into it", [&](std::size_t i) { return materials[i].has_factor_beyond; });
}

}  // namespace dmpc::apps::gltf
