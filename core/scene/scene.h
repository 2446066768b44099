// A scene as a file says it: objects in file order, materials, lights and a view, in double precision and world
// coordinates. It lives on the host only; core/database/database.h turns it into flat records for the nodes.
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

/// What alpha, of a texture's texels or of corners' colours, does to a surface: nothing; what is there shows what is behind by
/// the share that is not; or it is there altogether from a cutoff on, and below that not at all.
enum class AlphaUse : std::uint8_t { none, blend, cut };

/// What a texture of metal and roughness does: it lies where that of the colour does, or its mean is meant.
enum class FacetTexture : std::uint8_t { placed, mean };

/// A surface of tiny mirrors, as glTF's metallic-roughness has it (core/picture/surfaces/microfacet_lobes.h). What it scatters or
/// reflects as a metal has the material's colour; light, index and alpha are the material's, too.
struct Microfacets {
  double roughness = -1;      ///< 0 to 1; below 0 there are none
  double metallic = 0;        ///< 0 to 1
  double reflectance = 0.04;  ///< 0 to 1: what is no metal reflects so much straight ahead
  double transmission = 0;    ///< 0 to 1: of what is no metal, the share that lets light through in place of scattering it
  double opacity = 1;         ///< 0 to 1: the share of the surface that is there
  /// The texture by whose blue `metallic` is multiplied, and by whose green `roughness` is: index into Scene::textures, of
  /// TexelFormat::linear. Such a material has a texture of its colour, too, and is one of textured patches alone.
  std::uint32_t texture = no_texture;
  FacetTexture use = FacetTexture::placed;

  static constexpr std::uint32_t no_texture = 0xffffffffU;
  constexpr bool are_there() const { return roughness >= 0; }
  constexpr bool have_texture() const { return texture != no_texture; }
  constexpr bool operator==(const Microfacets&) const = default;
};

/// NFF's `f`: what an object's surface does with light (E. Haines, SPD, NFF.TXT), and behind it what only other formats know.
struct Material {
  Vec3d color{0.5, 0.5, 0.5};   ///< of the diffuse part, 0..1
  double diffuse = 1;           ///< Kd
  double specular = 0;          ///< Ks: weight of the highlight and of the mirror
  double shine = 0;             ///< Phong's cosine power
  double transmittance = 0;     ///< T; above 0 the surface transmits
  double refraction_index = 1;  ///< of the inside; meaningful when transmittance > 0 only
  /// What `color` is multiplied by on textured patches: index into Scene::textures.
  std::uint32_t texture = no_texture;
  AlphaUse alpha = AlphaUse::none;
  double alpha_cutoff = 0;        ///< of AlphaUse::cut: above 0, at most 1
  Vec3d specular_color{1, 1, 1};  ///< of highlight and mirror: what `specular` is multiplied by
  double tinted_specular = 0;     ///< weight of more highlight and mirror in the surface's own colour, as metals have
  double mirror = 1;              ///< the share of both that mirrors; 0 where there is a highlight alone
  Vec3d emission;                 ///< radiance of its own, which lights nothing else
  /// What pictures by paths show of the surface in place of `diffuse`, what is specular and `transmittance`, which approximate
  /// it.
  Microfacets microfacets;

  static constexpr std::uint32_t no_texture = Microfacets::no_texture;
  bool operator==(const Material&) const = default;

  /// Whether NFF cannot say all of it: then the database has a MaterialExtensionRecord for it.
  bool has_extension() const;
  /// Whether it has light of its own.
  bool shines() const { return emission != Vec3d{}; }
  /// Whether light may come through it somewhere.
  bool lets_through() const { return transmittance > 0 || alpha != AlphaUse::none; }
  /// Of faces that cover each other in one plane the least shows: what shines before what does not, and before both what lets no
  /// light through, so that a lamp lights in its ceiling's plane, and a glass box shows the floor that it stands on.
  int rank_in_plane() const { return (lets_through() ? 2 : 0) + (shines() ? 0 : 1); }
  /// The most of highlight and mirror in any channel, if `color` is multiplied by no more than `texture_max`.
  double specular_max(double texture_max = 1) const;
};

/// NFF's `l`: a point light, without fall-off unless that is said. Nothing is to be seen of it.
struct PointLight {
  Vec3d position;
  Vec3d color{1, 1, 1};
  bool has_color = false;  ///< false: the file gave no colour, and every such light gets 1/sqrt(number of lights)
  /// Above 0 it falls off with the square of the distance, and `color` is what it is 1 away, in the scene's units. What is nearer
  /// than this may be brighter than a film is made for.
  double falls_off_from = 0;
  LightCone cone = {};

  /// Whether NFF can say it.
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

/// A vertex of a textured or coloured patch beside its position.
struct TexturedCorner {
  Vec3d normal;  ///< need not be of unit length; 0 at all corners of a flat patch
  /// On the texture: s to the right, t downwards, 0 to 1 over the whole. Where the material has no texture: the bits of a
  /// CornerColor, by which the material's colour is multiplied.
  std::array<float, 2> place{};
};

/// One with a linear colour; it and alpha are brought to 0 to 1, in steps of 1 in 65535.
TexturedCorner colored_corner(const Vec3d& normal, const Vec3d& color, double alpha = 1);

enum class ObjectKind : std::uint8_t { polygon, patch, textured, sphere, cone };

/// One entity of the file. `first` indexes the pool of its kind: vertices (polygon, patch, textured), spheres, cones.
struct Object {
  ObjectKind kind{};
  std::uint32_t material = 0;  ///< index into Scene::materials
  std::uint32_t first = 0;
  std::uint32_t vertex_count = 0;  ///< polygon, patch, textured: at least 3; else 0
  /// patch: index into Scene::normals, textured: into Scene::corners, vertex_count of them.
  std::uint32_t first_normal = 0;
};

struct BaseMeshes;

struct Scene {
  static constexpr int bounces_max = 253;

  std::string name;  ///< the file's path or the built-in name, for messages
  View view;
  Vec3d background;  ///< linear RGB, as the file gives it
  Vec3d ambient;     ///< light that comes to every hit alike, from everywhere: its diffuse part reflects that, too
  std::vector<PointLight> lights;
  std::vector<Material> materials;  ///< equal ones merged
  std::vector<Object> objects;      ///< in file order
  std::vector<Vec3d> vertices;
  std::vector<Vec3d> normals;  ///< of patches; need not be of unit length
  std::vector<TexturedCorner> corners;
  std::vector<Sphere> spheres;
  std::vector<Cone> cones;
  std::vector<Texture> textures;
  SkyTexels sky;               ///< by paths, what no ray meets, if it is there
  Vec3d zenith;                ///< of a sky, of unit length, wherever the scene is seen from; 0: where the view's up points
  std::optional<int> bounces;  ///< by paths, how often its file has light go on; nothing where it does not say that
  /// What the file's coordinates have lost of those that were meant, as a share of them: 0x1p-25 where it keeps them in single
  /// precision. So much does not tell two planes apart.
  double coordinate_rounding = 0;
  /// Which of the objects are copies of meshes that stand in several places (core/scene/base_meshes.h); null if none are. Copies
  /// of a scene have it in common.
  std::shared_ptr<const BaseMeshes> kept;
};

/// What a light of the scene shines with. One without a colour shines with 1 / sqrt(number of lights): twice Haines' suggestion,
/// since nothing here is ambient.
Vec3d intensity_of(const PointLight& light, const Scene& scene);

/// Of unit length. Requires a view that makes a picture.
Vec3d zenith_of(const Scene& scene);

/// What takes the entities of a scene one by one, in a file's order: a builder, a writer, or a step on the way to one. Objects
/// get the material given last before them.
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

  /// The same of so many vertices as the caller gives the scene later, those of all objects in their order.
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
  std::size_t vertices_;  ///< of all objects so far
  std::unordered_map<Material, std::uint32_t, MaterialHash> materials_;
  std::uint32_t material_ = 0;
  bool has_material_ = false;
};

/// Sends a whole scene in file order: background, view, lights, then the objects, with the material wherever it changes. Without
/// its textures and corners' colours, which no sink knows: such patches come as plain ones.
void replay(const Scene& scene, SceneSink& sink);

/// Of objects in copies; as much as 2^48 stands for more, too.
struct ExpandedSize {
  std::uint64_t objects = 0, vertices = 0, normals = 0, corners = 0;

  std::uint64_t bytes() const {
    return sizeof(Object) * objects + sizeof(Vec3d) * (vertices + normals) + sizeof(TexturedCorner) * corners;
  }
  /// Throws CapacityError if that is more than indices of 32 bits reach.
  void check() const;
};

constexpr ExpandedSize operator+(const ExpandedSize& a, const ExpandedSize& b) {
  const auto sum = [](std::uint64_t x, std::uint64_t y) { return std::min(x + y, std::uint64_t{1} << 48U); };
  return {sum(a.objects, b.objects), sum(a.vertices, b.vertices), sum(a.normals, b.normals), sum(a.corners, b.corners)};
}

/// Of a scene's own objects.
ExpandedSize size_of_pools(const Scene& scene);

}  // namespace dmpc::core
