#include "apps/foreign/gltf/materials.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <memory>

#include "apps/edge/line/shown_text.h"
#include "apps/foreign/mesh/count_note.h"
#include "core/base/elementary.h"

namespace dmpc::apps::gltf {
namespace {

/// A member that refers to a texture is called so: "normalTexture".
bool is_texture(const std::string& key) { return key.size() >= 7 && key.compare(key.size() - 7, 7, "Texture") == 0; }

void add_number(aiMaterial& target, double value, const char* key, unsigned type, unsigned index) {
  const auto number = static_cast<ai_real>(value);
  target.AddProperty(&number, 1, key, type, index);
}

aiTextureMapMode edge_mode(const Part& sampler, const std::string& key) {
  const std::uint64_t mode = sampler.whole(key, 10497);
  if (mode != 10497 && mode != 33071 && mode != 33648) {
    sampler.get(key).fail("is " + std::to_string(mode) + ", expected 10497, 33071 or 33648");
  }
  return mode == 33071 ? aiTextureMapMode_Clamp : mode == 33648 ? aiTextureMapMode_Mirror : aiTextureMapMode_Wrap;
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
  unsigned coordinates;
  TexturePlace place;
};

TextureLayout layout_of(const Part& use) {
  const std::uint64_t plain = use.whole("texCoord", 0);
  const auto transform = use.extension("KHR_texture_transform");
  const std::uint64_t coordinates = transform ? transform->whole("texCoord", plain) : plain;
  return {static_cast<unsigned>(std::min<std::uint64_t>(coordinates, AI_MAX_NUMBER_OF_TEXTURECOORDS)),
          transform ? transformed(*transform) : TexturePlace{}};
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

class Writer {
 public:
  Writer(const Document& document, Images& images)
      : root_(document.root()),
        textures_(root_.list("textures")),
        samplers_(root_.list("samplers")),
        image_count_(root_.list("images").size()),
        images_(images) {}

  std::unique_ptr<aiMaterial> material(const Part& source, MaterialTextures& textures);
  /// How often a texture was named that names no picture.
  std::uint64_t without_picture() const { return without_picture_; }

 private:
  void add_texture(const Part& use, aiMaterial& target, aiTextureType type, unsigned number);
  void add_colour_texture(const Part& use, aiMaterial& target, TexturePlace& place);
  void add_facet_texture(const Part& use, MaterialTextures& textures);
  const Part& texture_of(const Part& use) const { return textures_[use.required_index("index", textures_.size(), "textures")]; }
  std::array<aiTextureMapMode, 2> edges_of(const Part& texture) const;
  /// All but those of the colour and of what `base` says of metal, at any depth that makes sense.
  void add_others(const Part& source, const Base& base, aiMaterial& target, unsigned& number, int level = 0);
  std::optional<std::size_t> image_of(const Part& texture) const;

  Part root_;
  std::vector<Part> textures_, samplers_;
  std::size_t image_count_;
  Images& images_;
  std::uint64_t without_picture_ = 0;
};

void add_base(const Base& base, aiMaterial& target) {
  const std::vector<double> color = base.colours.numbers(base.color, {1, 1, 1, 1});
  const aiColor4D colour(static_cast<ai_real>(color[0]), static_cast<ai_real>(color[1]), static_cast<ai_real>(color[2]),
                         static_cast<ai_real>(color[3]));
  target.AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
  add_number(target, color[3], AI_MATKEY_OPACITY);
  if (base.is_glossy) {
    add_number(target, 0, AI_MATKEY_METALLIC_FACTOR);
    add_number(target, 1 - base.roughness.number("glossinessFactor", 1), AI_MATKEY_ROUGHNESS_FACTOR);
  } else {
    add_number(target, base.roughness.number("metallicFactor", 1), AI_MATKEY_METALLIC_FACTOR);
    add_number(target, base.roughness.number("roughnessFactor", 1), AI_MATKEY_ROUGHNESS_FACTOR);
  }
}

void add_extensions(const Part& source, aiMaterial& target) {
  if (const auto ior = source.extension("KHR_materials_ior")) {
    add_number(target, ior->number("ior", 1.5), AI_MATKEY_REFRACTI);
  }
  if (const auto transmission = source.extension("KHR_materials_transmission")) {
    add_number(target, transmission->number("transmissionFactor", 0), AI_MATKEY_TRANSMISSION_FACTOR);
  }
  if (const auto coat = source.extension("KHR_materials_clearcoat")) {
    add_number(target, coat->number("clearcoatFactor", 0), AI_MATKEY_CLEARCOAT_FACTOR);
  }
}

std::string alpha_mode(const Part& source) {
  std::string mode = source.text("alphaMode", "OPAQUE");
  if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
    source.get("alphaMode").fail("is '" + clipped(mode, 40) + "', expected OPAQUE, MASK or BLEND");
  }
  return mode;
}

void add_look(const Part& source, aiMaterial& target) {
  const std::vector<double> light = source.numbers("emissiveFactor", {0, 0, 0});
  const auto stronger = source.extension("KHR_materials_emissive_strength");
  const double strength = stronger ? stronger->number("emissiveStrength", 1) : 1;
  const auto channel = [&](std::size_t i) { return static_cast<ai_real>(light[i] * strength); };
  const aiColor3D emission(channel(0), channel(1), channel(2));
  target.AddProperty(&emission, 1, AI_MATKEY_COLOR_EMISSIVE);
  const aiString mode(alpha_mode(source)), name(source.text("name", ""));
  target.AddProperty(&mode, AI_MATKEY_GLTF_ALPHAMODE);
  add_number(target, source.number("alphaCutoff", 0.5), AI_MATKEY_GLTF_ALPHACUTOFF);
  target.AddProperty(&name, AI_MATKEY_NAME);
}

std::optional<std::size_t> Writer::image_of(const Part& texture) const {
  for (const char* const format : {"EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds", "KHR_texture_basisu"}) {
    const auto other = texture.extension(format);
    if (other && !texture.find("source")) {
      return other->index("source", image_count_, "images");
    }
  }
  return texture.index("source", image_count_, "images");
}

void Writer::add_texture(const Part& use, aiMaterial& target, aiTextureType type, unsigned number) {
  const auto image = image_of(texture_of(use));
  without_picture_ += image ? 0 : 1;
  if (image) {
    const aiString name(images_.name_of(*image));
    target.AddProperty(&name, AI_MATKEY_TEXTURE(type, number));
  }
}

std::array<aiTextureMapMode, 2> Writer::edges_of(const Part& texture) const {
  const auto sampler = texture.index("sampler", samplers_.size(), "samplers");
  return {sampler ? edge_mode(samplers_[*sampler], "wrapS") : aiTextureMapMode_Wrap,
          sampler ? edge_mode(samplers_[*sampler], "wrapT") : aiTextureMapMode_Wrap};
}

void Writer::add_colour_texture(const Part& use, aiMaterial& target, TexturePlace& place) {
  add_texture(use, target, aiTextureType_BASE_COLOR, 0);
  const auto edges = edges_of(texture_of(use));
  const std::array<int, 2> modes = {edges[0], edges[1]};
  target.AddProperty(&modes[0], 1, AI_MATKEY_MAPPINGMODE_U(aiTextureType_BASE_COLOR, 0));
  target.AddProperty(&modes[1], 1, AI_MATKEY_MAPPINGMODE_V(aiTextureType_BASE_COLOR, 0));
  const TextureLayout layout = layout_of(use);
  place = layout.place;
  const int set = static_cast<int>(layout.coordinates);
  target.AddProperty(&set, 1, AI_MATKEY_UVWSRC(aiTextureType_BASE_COLOR, 0));
}

void Writer::add_facet_texture(const Part& use, MaterialTextures& textures) {
  const Part& texture = texture_of(use);
  const auto image = image_of(texture);
  without_picture_ += image ? 0 : 1;
  if (image) {
    const auto edges = edges_of(texture);
    const TextureLayout layout = layout_of(use);
    textures.facets = TextureUse{.path = images_.name_of(*image),
                                 .coordinates = layout.coordinates,
                                 .edges = {.s = wrap_of(edges[0]), .t = wrap_of(edges[1])}};
    textures.facets_place = layout.place;
  }
}

void Writer::add_others(const Part& source, const Base& base, aiMaterial& target, unsigned& number, int level) {
  constexpr int levels_max = 16;
  if (level > levels_max) {
    source.fail("extensions within each other more than 16 deep, expected one or two");
  }
  for (const auto& [key, part] : source.members()) {
    if (key == "baseColorTexture" || key == "diffuseTexture" || key == base.facets) {
      continue;
    }
    if (key == "emissiveTexture") {
      add_texture(part, target, aiTextureType_EMISSIVE, 0);
    } else if (is_texture(key)) {
      add_texture(part, target, aiTextureType_UNKNOWN, number);
      ++number;
    } else if (key == "extensions" || key == "pbrMetallicRoughness" || key.substr(0, 4) == "KHR_") {
      add_others(part, base, target, number, level + 1);
    }
  }
}

std::unique_ptr<aiMaterial> Writer::material(const Part& source, MaterialTextures& textures) {
  static const nlohmann::json nothing = nlohmann::json::object();
  auto target = std::make_unique<aiMaterial>();
  const Base base = base_of(source, Part(nothing));
  add_base(base, *target);
  add_look(source, *target);
  add_extensions(source, *target);
  if (const auto texture = base.colours.find(base.texture)) {
    add_colour_texture(*texture, *target, textures.color_place);
  }
  if (const auto texture = base.roughness.find(base.facets)) {
    add_facet_texture(*texture, textures);
  }
  unsigned number = 0;
  add_others(source, base, *target, number);
  return target;
}

}  // namespace

std::vector<MaterialTextures> add_materials(const Document& document, Images& images, aiScene& scene,
                                            std::vector<std::string>& notes) {
  static const nlohmann::json nothing = nlohmann::json::object();
  std::vector<Part> sources = document.root().list("materials");
  sources.emplace_back(nothing);
  Writer writer(document, images);
  std::vector<MaterialTextures> textures;
  scene.mMaterials = new aiMaterial*[sources.size()];
  for (const Part& source : sources) {
    scene.mMaterials[scene.mNumMaterials] = writer.material(source, textures.emplace_back()).release();
    ++scene.mNumMaterials;
  }
  note_count(notes, "textures that name no picture, left out", writer.without_picture());
  return textures;
}

}  // namespace dmpc::apps::gltf
