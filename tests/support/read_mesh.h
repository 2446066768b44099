// Mesh files that tests write and have read.
#pragma once

#include <string>

#include "apps/formats/mesh_file.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests {

inline apps::MeshFile read_mesh(const std::string& name, const std::string& text, const apps::MeshOptions& options = {}) {
  const TemporaryFolder folder;
  write_text(folder / name, text);
  return apps::read_mesh_file(folder / name, options);
}

/// What is said of a file that is refused; empty if it is read.
inline std::string mesh_refusal(const std::string& name, const std::string& text, const apps::MeshOptions& options = {}) {
  return complaint_of([&] { read_mesh(name, text, options); });
}

inline bool notes(const apps::MeshFile& file, const std::string& what) {
  for (const std::string& note : file.notes) {
    if (contains(note, what)) {
      return true;
    }
  }
  return false;
}

inline std::string with(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

inline const core::Material& material_of_object(const apps::MeshFile& file, std::size_t object) {
  return file.scene.materials[file.scene.objects.at(object).material];
}

inline core::Vec3d color_of_object(const apps::MeshFile& file, std::size_t object) {
  return material_of_object(file, object).color;
}

}  // namespace dmpc::tests
