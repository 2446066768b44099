// The materials that an OBJ file names, from the files in which they are.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "apps/foreign/mesh/scene_files.h"
#include "apps/foreign/obj/mtl.h"

namespace dmpc::apps::obj {

/// Finds materials in these files by name: first the name as it stands, then without a trailing remark; of several materials with
/// one name the first counts.
class Libraries {
 public:
  /// `wanted`: names as usemtl says them.
  Libraries(const std::vector<std::string>& wanted, const std::filesystem::path& scene, SceneFiles& files);

  /// Reads what a line names behind mtllib: one file whose name has blanks, if there is one, else a list. Throws core::InputError
  /// with the file's name for what the file may not say.
  void read(const std::string& names);

  /// Nothing if no file has it.
  const MtlMaterial* find(const std::string& name) const;

  std::vector<std::string> notes;    ///< what of the files is not shown, a sentence each
  std::vector<std::string> missing;  ///< which files cannot be had, a sentence each

  /// Appends what is known of all of them.
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
  std::map<std::string, std::size_t, std::less<>> names_, short_names_;  ///< as they stand, and without what looks like a remark
  std::size_t repeated_ = 0;
};

}  // namespace dmpc::apps::obj
