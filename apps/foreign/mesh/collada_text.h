// What a Collada file's own words say where Assimp has words of its own.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// The text as Assimp 5.2.5 is to get it. An effect that says nothing of a highlight gets a specular colour of 0.4 and a
/// shininess of 10 from Assimp: here it says that it has none, and lambert and constant say so whatever stands in them, since
/// they have none (Collada 1.4.1, chapter 8). A camera without a name, or with a vertical angle alone, would see 0.8 degrees:
/// here it is named by its id, and its aspect is 1.
std::string collada_in_full(std::string_view text);

/// Which sets of texture coordinates there are in the file: Assimp's meshes count those that they have, from 0 on, and its
/// materials go by the file's numbers.
std::set<unsigned> collada_texture_sets(std::string_view text);

}  // namespace dmpc::apps
