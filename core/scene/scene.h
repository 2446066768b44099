// A scene as described by a file: objects in file order, materials, lights and a view, in double precision and world coordinates.
// It lives on the host only; core/database/database.h turns it into flat records for the nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/base/vec.h"
#include "core/record/light_spread.h"
#include "core/scene/sky_texels.h"
#include "core/scene/texture.h"

namespace dmpc::core {

/// The effect of alpha, of a texture's texels or of corners' colours, on a surface: none; blending with what is behind; or a
/// cutoff, from which on the surface is opaque, and below which it is absent.
enum class AlphaUse : std::uint8_t { none, blend, cut };

/// The use of a texture of metal and roughness: in the same place as that of the colour, or as its mean.
enum class FacetTexture : std::uint8_t { placed, mean };

/// A microfacet surface as in glTF's metallic-roughness (core/picture/surfaces/microfacet_lobes.h). What it scatters or reflects
/// as a metal has the material's colour; emission, index and alpha are the material's, too.
struct Microfacets {
  double roughness = -1;      ///< 0 to 1; below 0: no microfacet surface
  double metallic = 0;        ///< 0 to 1
  double reflectance = 0.04;  ///< 0 to 1: the dielectric's at normal incidence
  double transmission = 0;    ///< 0 to 1: the dielectric's share that transmits light instead of scattering it
  double opacity = 1;         ///< 0 to 1: coverage of the surface
  /// The texture whose blue is a factor of `metallic`, and whose green of `roughness`: index into Scene::textures, of
  /// TexelFormat::linear. Such a material has a texture of its colour, too, and is used by textured patches only.
  std::uint32_t texture = no_texture;
  FacetTexture use = FacetTexture::placed;

  static constexpr std::uint32_t no_texture = 0xffffffffU;
  constexpr bool are_there() const { return roughness >= 0; }
  constexpr bool have_texture() const { return texture != no_texture; }
  constexpr bool operator==(const Microfacets&) const = default;
};

/// NFF's `f`: an object's surface (E. Haines, SPD, NFF.TXT), followed by extensions for other formats.
struct Material {
  Vec3d color{0.5, 0.5, 0.5};   ///< the diffuse part's, 0..1
  double diffuse = 1;           ///< Kd
  double specular = 0;          ///< Ks: weight of the highlight and of the mirror
  double shine = 0;             ///< Phong's cosine power
  double transmittance = 0;     ///< T; above 0 the surface transmits
  double refraction_index = 1;  ///< the inside's; used only if transmittance > 0
  /// Multiplies `color` on textured patches: index into Scene::textures.
  std::uint32_t texture = no_texture;
  AlphaUse alpha = AlphaUse::none;
  double alpha_cutoff = 0;        ///< for AlphaUse::cut: above 0, at most 1
  Vec3d specular_color{1, 1, 1};  ///< tint of highlight and mirror: a factor of `specular`
  double tinted_specular = 0;     ///< weight of further highlight and mirror in the surface's own colour, as for metals
  double mirror = 1;              ///< the share of both that mirrors; 0 for highlights only
  Vec3d emission;                 ///< its own radiance
  /// Used by pictures by paths in place of `diffuse`, the specular part and `transmittance`, which approximate it.
  Microfacets microfacets;

  static constexpr std::uint32_t no_texture = Microfacets::no_texture;
  bool operator==(const Material&) const = default;

  /// Whether it exceeds NFF: then the database has a MaterialExtensionRecord for it.
  bool has_extension() const;
  /// Whether it is an emitter.
  bool shines() const { return emission != Vec3d{}; }
  /// Whether it may transmit light somewhere.
  bool lets_through() const { return transmittance > 0 || alpha != AlphaUse::none; }
  /// The visible one of faces that cover each other in one plane has the least rank: emitters before others, and before both
  /// opaque ones, so that a lamp is visible in its ceiling's plane, and a glass box shows the floor that it stands on.
  int rank_in_plane() const { return (lets_through() ? 2 : 0) + (shines() ? 0 : 1); }
  /// The maximum of highlight and mirror in any channel, if `color` is multiplied by at most `texture_max`.
  double specular_max(double texture_max = 1) const;
};

/// NFF's `l`: a point light, without fall-off by default, and invisible.
struct PointLight {
  Vec3d position;
  Vec3d color{1, 1, 1};
  bool has_color = false;  ///< false: the file gave no colour, and every such light gets 1/sqrt(number of lights)
  /// Above 0 it falls off with the square of the distance, and `color` is its intensity at distance 1, in the scene's units. What
  /// is nearer than this may be brighter than the film's range.
  double falls_off_from = 0;
  LightCone cone = {};

  /// Whether NFF can express it.
  bool is_plain() const { return falls_off_from == 0 && cone.none_degrees == 0; }
};

/// NFF's `v`.
struct View {
  Vec3d from{0, 0, 1}, at{0, 0, 0}, up{0, 1, 0};
  double angle_degrees = 45;  ///< from the centre of the first to the centre of the last pixel row
  double hither = 0;          ///< kept for writing; tracing ignores it
  int width = 512, height = 512;
};

/// Radius below 0: only the inside is visible.
struct Sphere {
  Vec3d center;
  double radius = 1;
};

/// An open cone or (equal radii) cylinder. Both radii below 0: only the inside is visible.
struct Cone {
  Vec3d base;
  double base_radius = 1;
  Vec3d apex;
  double apex_radius = 1;
};

/// A vertex of a textured or coloured patch in addition to its position.
struct TexturedCorner {
  Vec3d normal;  ///< need not be of unit length; 0 at all corners of a flat patch
  /// Position on the texture: s to the right, t downwards, 0 to 1 over the whole. If the material has no texture: the bits of a
  /// CornerColor, a factor of the material's colour.
  std::array<float, 2> place{};
};

/// A corner with a linear colour, which is clamped with alpha to 0 to 1, in steps of 1 in 65535.
TexturedCorner colored_corner(const Vec3d& normal, const Vec3d& color, double alpha = 1);

enum class ObjectKind : std::uint8_t { polygon, patch, textured, sphere, cone };
inline constexpr std::size_t object_kind_count = 5;

/// One entity of the file. `first` indexes the pool of its kind: vertices (polygon, patch, textured), spheres, cones.
struct Object {
  ObjectKind kind{};
  std::uint32_t material = 0;  ///< index into Scene::materials
  std::uint32_t first = 0;
  std::uint32_t vertex_count = 0;  ///< polygon, patch, textured: at least 3; else 0
  /// patch: index into Scene::normals, textured: into Scene::corners; there are vertex_count of them.
  std::uint32_t first_normal = 0;
};

struct BaseMeshes;
struct StoredObjects;

struct Scene {
  static constexpr int bounces_max = 253;

  std::string name;  ///< the file's path or the built-in name, for messages
  View view;
  Vec3d background;  ///< linear RGB, as the file gives it
  Vec3d ambient;     ///< light that comes uniformly to every hit, and is reflected by its diffuse part
  std::vector<PointLight> lights;
  std::vector<Material> materials;  ///< equal ones merged
  std::vector<Object> objects;      ///< in file order
  std::vector<Vec3d> vertices;
  std::vector<Vec3d> normals;  ///< for patches; need not be of unit length
  std::vector<TexturedCorner> corners;
  std::vector<Sphere> spheres;
  std::vector<Cone> cones;
  std::vector<Texture> textures;
  SkyTexels sky;               ///< with paths, the background, if there is one
  Vec3d zenith;                ///< the sky's, unit length, for any view; 0: the view's up
  std::optional<int> bounces;  ///< with paths, the number of bounces in the file, if given
  /// The relative error of the file's coordinates: 0x1p-25 if it stores them in single precision. Smaller differences do not
  /// distinguish two planes.
  double coordinate_rounding = 0;
  /// The objects that are copies of meshes with several instances (core/scene/base_meshes.h); null if there are none. Copies of a
  /// scene share it.
  std::shared_ptr<const BaseMeshes> kept;
  /// Of a scene that is in a database: it has no objects and no texels, but this about them (core/scene/stored_objects.h).
  std::shared_ptr<const StoredObjects> stored;
};

/// The intensity of a light of the scene. One without a colour has 1 / sqrt(number of lights): twice Haines' suggestion, since
/// there is no ambient light here.
Vec3d intensity_of(const PointLight& light, const Scene& scene);

/// A unit vector. Requires a view that makes a picture.
Vec3d zenith_of(const Scene& scene);

/// A consumer of the entities of a scene, one by one, in a file's order: a builder, a writer, or an intermediate step. Objects
/// get the last material before them.
class SceneSink {
 public:
  virtual ~SceneSink() = default;

  virtual void background(const Vec3d& color) = 0;
  virtual void view(const View& view) = 0;
  virtual void light(const PointLight& light) = 0;
  virtual void material(const Material& material) = 0;
  /// At least 3 vertices.
  virtual void polygon(const std::vector<Vec3d>& vertices) = 0;
  /// At least 3 vertices and one normal for each.
  virtual void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) = 0;
  virtual void sphere(const Vec3d& center, double radius) = 0;
  virtual void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) = 0;
};

/// Adds entities to a scene. Equal materials are merged; objects before the first material get Material{}. Throws InputError when
/// a pool outgrows its 32-bit indices. The scene must outlive the builder, and only one builder may be at work on it.
class SceneBuilder final : public SceneSink {
 public:
  explicit SceneBuilder(Scene& scene);

  void background(const Vec3d& color) override;
  void view(const View& view) override;
  void light(const PointLight& light) override;
  void material(const Material& material) override;
  void polygon(const std::vector<Vec3d>& vertices) override;
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) override;
  void sphere(const Vec3d& center, double radius) override;
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override;
  /// A patch, or a polygon, whose material has a texture, or whose corners have colours. At least 3 vertices and a corner for
  /// each.
  void textured(const std::vector<Vec3d>& vertices, const std::vector<TexturedCorner>& corners);

  /// polygon() for `vertex_count` vertices that the caller adds to the scene later, those of all objects in their order.
  void polygon(std::size_t vertex_count);
  void patch(std::size_t vertex_count, const std::vector<Vec3d>& normals);
  void textured(std::size_t vertex_count, const std::vector<TexturedCorner>& corners);

 private:
  struct MaterialHash {
    std::size_t operator()(const Material& material) const;
  };

  void add_face(ObjectKind kind, std::size_t vertex_count, std::size_t first_normal);
  void add(ObjectKind kind, std::size_t first, std::size_t vertex_count, std::size_t first_normal);

  Scene& scene_;
  std::size_t vertices_;  ///< number of all objects' vertices so far
  std::unordered_map<Material, std::uint32_t, MaterialHash> materials_;
  std::uint32_t material_ = 0;
  bool has_material_ = false;
};

/// Sends a whole scene in file order: background, view, lights, then the objects, with the material whenever it changes. Without
/// textures and corners' colours, which sinks do not support: such patches become plain ones.
void replay(const Scene& scene, SceneSink& sink);

/// The size of objects in copies; 2^48 stands for more, too.
struct ExpandedSize {
  std::uint64_t objects = 0, vertices = 0, normals = 0, corners = 0;

  std::uint64_t bytes() const {
    return sizeof(Object) * objects + sizeof(Vec3d) * (vertices + normals) + sizeof(TexturedCorner) * corners;
  }
  /// Throws CapacityError if that exceeds indices of 32 bits.
  void check() const;
};

constexpr ExpandedSize operator+(const ExpandedSize& a, const ExpandedSize& b) {
  const auto sum = [](std::uint64_t x, std::uint64_t y) { return std::min(x + y, std::uint64_t{1} << 48U); };
  return {sum(a.objects, b.objects), sum(a.vertices, b.vertices), sum(a.normals, b.normals), sum(a.corners, b.corners)};
}

/// The size of a scene's own objects.
ExpandedSize size_of_pools(const Scene& scene);

}  // namespace dmpc::core
