// What a Collada file's own words say where Assimp has words of its own.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps {

/// The text as Assimp 5.2.5 is to get it, which
/// - gives an effect that says nothing of a highlight a specular colour of 0.4 and a shininess of 10: here it says that it has
///   none, and lambert and constant say so whatever stands in them, since they have none (Collada 1.4.1, chapter 8); constant
///   has no diffuse colour either, and what reflects says how much, all where the file does not;
/// - sees 0.8 degrees by a camera without a name, or with a vertical angle alone: here it is named by its id, its aspect is 1;
/// - gives faces that are bound to no material another's: here symbols begin with '=', so that they are no material's id, and
///   there is a grey material before all others, which such faces have;
/// - gives an effect of another profile than COMMON all that it makes up: here such a one is grey;
/// - looks for values by the letters XYZ, RGBA, STP and UV alone: here two to four numbers of other names have those;
/// - forgets which set of texture coordinates is bound: here the one that shows the texture has number 0.
/// Throws core::InputError as collada_sets() does.
std::string collada_in_full(std::string_view text);

}  // namespace dmpc::apps
