// What Assimp's importers make up of a file's words.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <string_view>

namespace dmpc::apps {

/// Materials as the file has them, of a scene that Assimp 5.2.5 has read from `file`, which ends in `ending` (lower case). What
/// has no material has no colour, whatever grey stands for it (FBX 0.8, X 0.5, 3DS 0.3). FBX: a roughness that was reckoned from
/// an exponent goes, and so does the highlight of what is not shaded by Phong, which a template has for all. AMF: black goes
/// where no colour is. Collada: a material's texture goes by a mesh's first set (collada_text.h). ASE: cameras look forwards, not
/// back.
void take_back_invented(aiScene& scene, const std::string& ending, std::string_view file);

/// Whether it stands for none in what was read of an X file: all that the file has have names, be they empty.
bool is_invented_for_x(const aiMaterial& material);

}  // namespace dmpc::apps
