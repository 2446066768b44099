// Looks up the materials that an OBJ file names in its material libraries.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "apps/foreign/mesh/scene_files.h"
#include "apps/foreign/obj/mtl.h"

namespace dmpc::apps::obj {

/// Finds materials by full name, then by the name without a trailing comment. Of several with one name the first wins.
class Libraries {
 public:
  /// `wanted` contains material names as written after usemtl.
  Libraries(const std::vector<std::string>& wanted, const std::filesystem::path& scene, SceneFiles& files);

  /// Reads the operand of mtllib: a single file whose name contains blanks, if that file exists, else a list of files. Throws
  /// core::InputError, with the file's name, for an invalid file.
  void read(const std::string& names);

  /// Returns nullptr if no file defines the material.
  const MtlMaterial* find(const std::string& name) const;

  std::vector<std::string> notes;    ///< one sentence per feature of the files that is not shown
  std::vector<std::string> missing;  ///< one sentence per file that could not be read

  /// Appends notes that concern all files together.
  void note_repeated(std::vector<std::string>& all) const;

 private:
  bool is_there(const std::string& name);
  void read_file(const std::string& name);
  void take(MtlMaterial material);

  std::unordered_set<std::string> wanted_;
  std::filesystem::path folder_;
  SceneFiles& files_;
  std::unordered_set<std::string> read_;
  std::vector<MtlMaterial> materials_;
  std::map<std::string, std::size_t, std::less<>> names_, short_names_;  ///< full names, and names without an apparent comment
  std::size_t repeated_ = 0;
};

}  // namespace dmpc::apps::obj
