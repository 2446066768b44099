// Any bytes as OBJ or MTL, by our readers: refused with core::InputError, or what they give holds together. The first byte says
// which.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/obj/mtl.h"
#include "apps/foreign/obj/reader.h"
#include "core/base/expect.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using Check = void (*)(std::string_view file);

void check_obj(std::string_view text) {
  InputFiles files("a.obj", std::as_bytes(std::span(text)));
  const apps::PlacedFile file = apps::read_obj("a.obj", files);
  for (const apps::PlacedShape& shape : file.shapes) {
    const apps::PolygonMesh& mesh = shape.mesh;
    const std::size_t corners = mesh.faces.corners.size();
    std::size_t faces = 0;
    for (const apps::FaceRun& run : mesh.runs) {
      core::expect(run.material < file.materials.size() && run.end > faces, "a run has a material and a face");
      faces = run.end;
    }
    core::expect(faces == mesh.faces.ends.size(), "each face is in a run");
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
