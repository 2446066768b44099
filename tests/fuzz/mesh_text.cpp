// Any bytes as OBJ or MTL, by our readers: refused with core::InputError, or what they give holds together. The first byte says
// which.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/obj/mtl.h"
#include "apps/foreign/obj/reader.h"
#include "core/base/expect.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using Check = void (*)(std::string_view file);

/// The text as the file of a scene, beside which there is nothing.
class OneFile final : public apps::SceneFiles {
 public:
  explicit OneFile(std::string_view text) : text_(text) {}

  std::unique_ptr<apps::FileBytes> open(const std::string& path) override {
    if (path != "a.obj") {
      throw core::InputError(path + " is missing");
    }
    return std::make_unique<Text>(text_);
  }
  bool exists(const std::string& path) override { return path == "a.obj"; }
  std::vector<std::filesystem::path> meant(const std::filesystem::path& /*folder*/, const std::string& /*name*/) override {
    return {};
  }
  void add_texture(const std::string& /*path*/, const apps::TextureEdges& /*edges*/) override {}
  void add_texture(std::span<const std::byte> /*file*/, const std::string& /*name*/, const std::string& /*format_hint*/,
                   const apps::TextureEdges& /*edges*/) override {}
  void add_texture(std::span<const std::uint32_t> /*texels*/, std::uint32_t /*width*/, std::uint32_t /*height*/,
                   const std::string& /*name*/, const apps::TextureEdges& /*edges*/) override {}
  void show_progress(float share) override { core::expect(share >= 0 && share <= 1, "progress is a share"); }

 private:
  class Text final : public apps::FileBytes {
   public:
    explicit Text(std::string_view text) : text_(text) {}
    std::span<const std::byte> bytes() const override { return std::as_bytes(std::span(text_)); }

   private:
    std::string_view text_;
  };
  std::string_view text_;
};

void check_obj(std::string_view text) {
  OneFile files(text);
  const apps::PlacedFile file = apps::read_obj("a.obj", files);
  for (const apps::PlacedShape& shape : file.shapes) {
    const apps::PolygonMesh& mesh = shape.mesh;
    const std::size_t corners = mesh.faces.corners.size();
    core::expect(mesh.material < file.materials.size(), "a mesh has a material");
    core::expect(!mesh.faces.ends.empty() && mesh.faces.ends.back() == corners, "all corners are of a face");
    core::expect(mesh.normals.empty() || mesh.normals.size() == corners, "a normal is of a corner");
    core::expect(mesh.places.empty() || mesh.places.size() == corners, "a place is of a corner");
    core::expect(mesh.colors.empty() || mesh.colors.size() == corners, "a colour is of a corner");
    for (const std::uint32_t vertex : mesh.faces.corners) {
      core::expect(vertex < mesh.vertices.size(), "a corner is of a vertex");
    }
  }
}

void check_mtl(std::string_view text) {
  std::vector<std::string> notes;
  apps::obj::parse_mtl(
      text,
      [](const apps::obj::MtlMaterial& material) {
        const core::Material shown = apps::obj::shown_material(material);
        core::expect(is_finite(shown.color) && shown.diffuse >= 0 && shown.diffuse <= 1, "a material is one of ours");
        core::expect(shown.transmittance >= 0 && shown.transmittance <= 1, "a material lets through a share");
      },
      notes);
}

}  // namespace

void try_mesh_text(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<Check, 2> checks{check_obj, check_mtl};
  if (size == 0) {
    return;
  }
  const std::string_view file(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::array<const char*, 2> kinds{"OBJ", "MTL"};
  const std::size_t kind = data[0] % checks.size();
  bool is_refused = false;
  try {
    checks[kind](file);
  } catch (const core::InputError& error) {
    core::expect(!std::string_view(error.what()).empty(), "who refuses says why");
    is_refused = true;
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    covered().count(std::string(kinds[i]) + " let pass", i == kind && !is_refused);
    covered().count(std::string(kinds[i]) + " refused", i == kind && is_refused);
  }
}

}  // namespace dmpc::fuzz
