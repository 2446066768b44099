// What Assimp's importers make up of a file's words.
#pragma once

#include <assimp/scene.h>

#include <string>

namespace dmpc::apps {

/// Materials as the file has them, of a scene that Assimp 5.2.5 has read from one that ends in `ending` (lower case). FBX: a
/// roughness that was reckoned from an exponent goes, and so does the highlight of what is not shaded by Phong, which a template
/// has for all; X3D: a shininess from 0 to 1 stands for exponents to 128.
void take_back_invented(aiScene& scene, const std::string& ending);

}  // namespace dmpc::apps
