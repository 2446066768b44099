#include "apps/render/picture_identity.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/digest.h"
#include "apps/picture/film_image.h"
#include "apps/run/render_record.h"
#include "core/base/ranges.h"
#include "core/scene/placed_objects.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {

namespace {

constexpr const char* view_fact = "view";

void add(Digest& digest, const core::Vec3d& vector) {
  digest.add(vector.x);
  digest.add(vector.y);
  digest.add(vector.z);
}

template <class T>
void add_all(Digest& digest, const std::vector<T>& values) {
  static_assert(sizeof(T) % alignof(double) == 0 && std::is_trivially_copyable_v<T>);
  digest.add(std::as_bytes(std::span(values)));
}

/// What the scene was known by when its database was built, or what it is known by now, as work() finds it.
template <class Work>
std::string stored_or(const core::Scene& scene, const char* name, const Work& work) {
  if (scene.stored == nullptr) {
    return work();
  }
  const auto found = scene.stored->identity.find(name);
  return found == scene.stored->identity.end() ? "" : found->second;
}

std::string text_of(const Digest& digest) { return "#" + hash_text(digest.value()); }

std::string text_of_pools(const core::Scene& scene) {
  static_assert(sizeof(core::Vec3d) == 24 && sizeof(core::TexturedCorner) == 32 && sizeof(core::Sphere) == 32 &&
                sizeof(core::Cone) == 64);  // no padding
  Digest digest;
  for (const core::Object& object : scene.objects) {
    digest.add(std::uint64_t{object.material} << 8U | static_cast<std::uint64_t>(object.kind));
    digest.add(std::uint64_t{object.first} << 32U | object.vertex_count);
    digest.add(std::uint64_t{object.first_normal});
  }
  add_all(digest, scene.vertices);
  add_all(digest, scene.normals);
  add_all(digest, scene.corners);
  add_all(digest, scene.spheres);
  add_all(digest, scene.cones);
  return text_of(digest);
}

/// Without copies of base meshes, which are in meshes_text(): so it is the same whether the scene has them or not.
std::string objects_text(const core::Scene& scene) {
  return stored_or(scene, "objects",
                   [&] { return scene.kept == nullptr ? text_of_pools(scene) : text_of_pools(without_copies(scene)); });
}

/// What is decided of meshes by themselves, and so does not follow from the objects (core/scene/base_meshes.h).
std::string meshes_text(const core::BaseMeshes& kept) {
  Digest digest;
  for (const core::Scene& mesh : kept.meshes) {
    digest.add(objects_text(mesh));
  }
  for (const core::BaseMeshInstance& place : kept.places) {
    for (const core::Vec3d& row : place.world.rows) {
      add(digest, row);
    }
    add(digest, place.world.shift);
    digest.add(std::uint64_t{place.mesh} << 32U | place.first);
  }
  return text_of(digest);
}

/// Empty for a scene without meshes in several places.
std::string meshes_text(const core::Scene& scene) {
  return stored_or(scene, "meshes", [&] { return scene.kept == nullptr ? "" : meshes_text(*scene.kept); });
}

/// What few materials have, and NFF cannot say.
void add_extension(Digest& digest, const core::Material& material) {
  add(digest, material.specular_color);
  add(digest, material.emission);
  for (const double number : {material.tinted_specular, material.mirror, material.alpha_cutoff}) {
    digest.add(number);
  }
  digest.add(static_cast<std::uint64_t>(material.alpha));
}

void add(Digest& digest, const core::Texture& texture) {
  digest.add(static_cast<std::uint64_t>(texture.format));
  digest.add(static_cast<std::uint64_t>(texture.wrap_s) << 8U | static_cast<std::uint64_t>(texture.wrap_t));
  for (const core::TextureLevel& level : texture.levels) {
    digest.add(std::uint64_t{level.width} << 32U | level.height);
    digest.add(std::as_bytes(std::span(level.texels)));
  }
}

/// What pictures by paths show of them beside.
std::string microfacets_text(const core::Scene& scene) {
  return stored_or(scene, "microfacets", [&] {
    Digest digest;
    for (const core::Material& material : scene.materials) {
      const core::Microfacets& facets = material.microfacets;
      for (const double number : {facets.roughness, facets.metallic, facets.reflectance, facets.transmission, facets.opacity}) {
        digest.add(number);
      }
      if (facets.have_texture()) {
        add(digest, scene.textures[facets.texture]);
      }
    }
    return text_of(digest);
  });
}

bool has_microfacets(const core::Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const core::Material& material) { return material.microfacets.are_there(); });
}

std::string materials_text(const core::Scene& scene) {
  Digest digest;
  for (const core::Material& material : scene.materials) {
    add(digest, material.color);
    for (const double number :
         {material.diffuse, material.specular, material.shine, material.transmittance, material.refraction_index}) {
      digest.add(number);
    }
    digest.add(std::uint64_t{material.texture});
    if (material.has_extension()) {
      add_extension(digest, material);
    }
  }
  return text_of(digest);
}

/// Digest of colour textures; others are part of their materials' text.
std::string textures_text(const core::Scene& scene) {
  return stored_or(scene, "textures", [&] {
    Digest digest;
    for (const core::Texture& texture : scene.textures) {
      if (texture.format != core::TexelFormat::linear) {
        add(digest, texture);
      }
    }
    return text_of(digest);
  });
}

std::string lights_text(const core::Scene& scene) {
  Digest digest;
  add(digest, scene.background);
  if (!(scene.ambient == core::Vec3d{})) {
    add(digest, scene.ambient);
  }
  for (const core::PointLight& light : scene.lights) {
    add(digest, light.position);
    add(digest, light.color);
    digest.add(std::uint64_t{light.has_color});
    if (!light.is_plain()) {
      digest.add(light.falls_off_from);
      add(digest, light.cone.ahead);
      digest.add(light.cone.full_degrees);
      digest.add(light.cone.none_degrees);
      digest.add(static_cast<std::uint64_t>(light.cone.edge));
    }
  }
  return text_of(digest);
}

std::string zenith_text(const core::Scene& scene) {
  Digest digest;
  add(digest, zenith_of(scene));
  return text_of(digest);
}

void add_samples(std::vector<PictureFact>& facts, const PictureOptions& picture) {
  facts.push_back({"samples", picture.is_refined ? "auto" : std::to_string(picture.samples)});
  if (picture.is_refined) {
    facts.push_back({"error", shortest(picture.refinement.error)});
    facts.push_back({"samples-max", std::to_string(picture.refinement.samples_max)});
    if (picture.refinement.kind == core::ErrorKind::noise) {
      facts.push_back({"estimate of noise", "by former changes, too"});  // by the last ones alone before there was this fact
    }
  }
}

/// Digest of a picture's contents, whatever its file is called.
std::string sky_text(const core::Scene& scene) {
  return stored_or(scene, "sky", [&sky = scene.sky] {
    Digest digest;
    digest.add(std::uint64_t{sky.width} << 32U | sky.height);
    digest.add(sky.scale);
    digest.add(std::as_bytes(std::span(sky.texels)));
    return text_of(digest);
  });
}

/// A picture whose texels are all alike counts as a sky of its colour, which is the background's.
std::string sky_text(const SkyChoice& sky, const core::Scene& scene) {
  return text_of(sky.is_picture() ? SkyChoice{.horizon = scene.background, .zenith = {}} : sky);
}

/// Pictures by Whitted's transport have no such text, as before other transports existed.
void add_transport(std::vector<PictureFact>& facts, const TransportOptions& transport, const core::Scene& scene) {
  if (!transport.is_by_paths()) {
    return;
  }
  facts.push_back({"transport", name_of(transport.kind)});
  if (transport.sky) {
    facts.push_back({"sky", scene.sky.is_there() ? sky_text(scene) : sky_text(*transport.sky, scene)});
  }
  if (transport.clamp > 0) {
    facts.push_back({"clamp", shortest(transport.clamp)});
  }
  if (transport.sky && zenith_of(scene) != normalize(scene.view.up)) {
    facts.push_back({"sky's zenith", zenith_text(scene)});  // before there was this fact, where the view's up points
  }
  const bool has_emitters = std::ranges::any_of(scene.materials, &core::Material::shines);
  if (has_emitters) {
    facts.push_back({"emitters", std::to_string(transport.emitters)});
  }
  if (has_emitters || scene.sky.is_there()) {
    facts.push_back({"light sampling", "by inversion"});  // by alias tables before there was this fact
  }
}

const PictureFact* find(const std::vector<PictureFact>& facts, const std::string& name) {
  return core::find_in(facts, name, &PictureFact::name);
}

/// How one fact differs; nullptr if a picture has none of the name.
std::string difference_text(const std::string& name, const PictureFact* other, const PictureFact* here) {
  if (other != nullptr && here != nullptr && other->value == here->value) {
    return "";
  }
  if (other == nullptr || here == nullptr) {
    return other == nullptr ? "no " + name : name + " is " + other->value + ", here there is none";
  }
  return other->value.starts_with('#') ? "other " + name : name + " is " + other->value + ", here " + here->value;
}

}  // namespace

std::map<std::string, std::string> stored_identity(const core::Scene& scene) {
  return {{"objects", objects_text(scene)},
          {"meshes", meshes_text(scene)},
          {"microfacets", microfacets_text(scene)},
          {"textures", textures_text(scene)},
          {"sky", sky_text(scene)}};
}

std::string view_text(const core::View& view) {
  Digest digest;
  for (const core::Vec3d& vector : {view.from, view.at, view.up}) {
    add(digest, vector);
  }
  digest.add(view.angle_degrees);
  return text_of(digest);
}

std::string difference_text(const std::vector<PictureFact>& other, const std::vector<PictureFact>& here) {
  std::vector<PictureFact> all = other;
  std::copy_if(here.begin(), here.end(), std::back_inserter(all),
               [&](const PictureFact& fact) { return find(other, fact.name) == nullptr; });
  std::string text;
  for (const PictureFact& fact : all) {
    const std::string difference = difference_text(fact.name, find(other, fact.name), find(here, fact.name));
    text += (text.empty() || difference.empty() ? "" : "; ") + difference;
  }
  return text;
}

PictureIdentity identity_of(const RenderOptions& options, const core::Scene& scene) {
  const PictureOptions& picture = options.picture;
  const Resolution size = picture.resolution.value_or(Resolution{scene.view.width, scene.view.height});
  PictureIdentity identity{size.width, size.height, {}, {}};
  std::vector<PictureFact>& facts = identity.facts;
  facts = {{"version of dmpc", DMPC_VERSION},
           {"resolution", std::to_string(size.width) + "x" + std::to_string(size.height)},
           {"objects", objects_text(scene)},
           {"materials", materials_text(scene)},
           {"textures", textures_text(scene)},
           {"lights or background", lights_text(scene)},
           {view_fact, view_text(scene.view)},
           picture.transport.is_by_paths() ? PictureFact{"bounces", std::to_string(depth_of(picture, scene) - 1)}
                                           : PictureFact{"depth", std::to_string(depth_of(picture, scene))},
           {"cutoff", shortest(picture.cutoff)},
           {"convention", picture.convention == core::Convention::haines ? "haines" : "paper"},
           {"tracer", options.tracer == TracerChoice::grid ? "grid" : "embree"},
           {"grid-axes", "world"}};  // there were others: a checkpoint that has them is of another picture
  if (const std::string meshes = meshes_text(scene); !meshes.empty()) {
    facts.push_back({"meshes in several places", meshes});  // judged where they stand before there was this
  }
  add_samples(facts, picture);
  add_transport(facts, picture.transport, scene);
  if (picture.transport.is_by_paths() && has_microfacets(scene)) {
    facts.push_back({"metal and roughness of materials", microfacets_text(scene)});
  }
  identity.terms = {static_cast<std::uint32_t>(picture.samples), picture.refinement, radiance_bound(picture, scene),
                    film_scale_of(picture, scene)};
  facts.push_back({film_scale_fact, text_of(identity.terms.film_scale)});
  return identity;
}

PictureIdentity identity_from(const core::View& view, PictureIdentity own) {
  const auto fact =
      std::find_if(own.facts.begin(), own.facts.end(), [](const PictureFact& one) { return one.name == view_fact; });
  core::expect(fact != own.facts.end(), "a picture has a view");
  const PictureFact scenes = {"scene's own view", std::exchange(fact->value, view_text(view))};
  own.facts.insert(fact + 1, scenes);
  return own;
}

std::uint64_t scene_digest(const core::Scene& scene) {
  Digest digest;
  for (const std::string& text :
       {objects_text(scene), materials_text(scene), textures_text(scene), lights_text(scene), view_text(scene.view)}) {
    digest.add(text);
  }
  if (const std::string meshes = meshes_text(scene); !meshes.empty()) {
    digest.add(meshes);
  }
  if (scene.sky.is_there()) {
    digest.add(sky_text(scene));
    add(digest, zenith_of(scene));
  }
  return digest.value();
}

}  // namespace dmpc::apps
