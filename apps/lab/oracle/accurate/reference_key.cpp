#include "apps/lab/oracle/accurate/reference_key.h"

#include <array>
#include <bit>
#include <cstdio>

#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// Two chains of core::mix with different beginnings.
class Digest {
 public:
  void add(std::uint64_t value) {
    for (std::size_t chain = 0; chain < 2; ++chain) {
      state_[chain] = core::mix(state_[chain] * 0x9e3779b97f4a7c15ULL + core::mix(value + chain));
    }
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec3d& v) { add(v.x), add(v.y), add(v.z); }

  std::string text() const {
    std::array<char, 33> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx%016llx", static_cast<unsigned long long>(state_[0]),
                  static_cast<unsigned long long>(state_[1]));
    return digits.data();
  }

 private:
  std::array<std::uint64_t, 2> state_{0x243f6a8885a308d3ULL, 0x13198a2e03707344ULL};  // digits of pi
};

/// Adds each entity with a number for its kind before it, and the length of what varies in length.
class HashingSink final : public core::SceneSink {
 public:
  explicit HashingSink(Digest& digest) : digest_(digest) {}

  void background(const Vec3d& color) override { begin(1), digest_.add(color); }
  void view(const core::View& view) override {
    begin(2);
    for (const Vec3d& v : {view.from, view.at, view.up}) {
      digest_.add(v);
    }
    digest_.add(view.angle_degrees);
  }
  void light(const core::PointLight& light) override {
    begin(3), digest_.add(light.position);
    digest_.add(light.has_color ? light.color : Vec3d{-1, -1, -1});
  }
  void material(const core::Material& material) override {
    begin(4), digest_.add(material.color);
    for (const double value :
         {material.diffuse, material.specular, material.shine, material.transmittance, material.refraction_index}) {
      digest_.add(value);
    }
    if (material.has_finish()) {
      begin(10), digest_.add(material.specular_color), digest_.add(material.emission);
      digest_.add(material.tinted_specular), digest_.add(material.mirror), digest_.add(material.alpha_cutoff);
      digest_.add(static_cast<std::uint64_t>(material.alpha));
    }
  }
  void polygon(const std::vector<Vec3d>& vertices) override { begin(5), add(vertices); }
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) override {
    begin(6), add(vertices), add(normals);
  }
  void sphere(const Vec3d& center, double radius) override { begin(7), digest_.add(center), digest_.add(radius); }
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override {
    begin(8), digest_.add(base), digest_.add(base_radius), digest_.add(apex), digest_.add(apex_radius);
  }

 private:
  void begin(std::uint64_t kind) { digest_.add(kind); }
  void add(const std::vector<Vec3d>& places) {
    digest_.add(std::uint64_t{places.size()});
    for (const Vec3d& place : places) {
      digest_.add(place);
    }
  }

  Digest& digest_;
};

/// What replay() leaves out; nothing where there is none.
void add_ambient(const core::Scene& scene, Digest& digest) {
  if (!(scene.ambient == Vec3d{})) {
    digest.add(std::uint64_t{10});
    digest.add(scene.ambient);
  }
}

/// What replay() leaves out, too.
void add_textures(const core::Scene& scene, Digest& digest) {
  for (const core::Texture& texture : scene.textures) {
    for (const std::uint64_t value : {std::uint64_t{9}, static_cast<std::uint64_t>(texture.format),
                                      static_cast<std::uint64_t>(texture.wrap_s), static_cast<std::uint64_t>(texture.wrap_t),
                                      std::uint64_t{texture.levels[0].width}, std::uint64_t{texture.levels[0].height}}) {
      digest.add(value);
    }
    for (const std::uint32_t texel : texture.levels[0].texels) {
      digest.add(std::uint64_t{texel});
    }
  }
  for (const core::Object& object : scene.objects) {
    for (std::uint32_t i = 0; object.kind == core::ObjectKind::textured && i < object.vertex_count; ++i) {
      const core::TexturedCorner& corner = scene.corners[object.first_normal + i];
      const bool is_color = scene.materials[object.material].texture == core::Material::no_texture;
      for (const float place : corner.place) {  // a colour's bits may be those of no number, which conversion would change
        is_color ? digest.add(std::uint64_t{std::bit_cast<std::uint32_t>(place)}) : digest.add(double{place});
      }
      digest.add(std::uint64_t{scene.materials[object.material].texture});
    }
  }
}

}  // namespace

std::string reference_key(const core::Scene& scene, const Resolution& resolution, const PictureOptions& picture,
                          const ReferenceOptions& options) {
  Digest digest;
  for (const std::uint64_t value :
       {reference_version, static_cast<std::uint64_t>(resolution.width), static_cast<std::uint64_t>(resolution.height),
        static_cast<std::uint64_t>(picture.depth), static_cast<std::uint64_t>(picture.convention),
        std::uint64_t{options.samples_a_side}, options.seed}) {
    digest.add(value);
  }
  HashingSink sink(digest);
  core::replay(scene, sink);
  add_ambient(scene, digest);
  add_textures(scene, digest);
  return digest.text();
}

}  // namespace dmpc::apps
