// Whether an STL file is whole, before Assimp reads it.
#pragma once

#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError for a file that ends before its end: of text within a facet or before `endsolid`, in binary before as
/// many facets as it says.
void check_stl(std::string_view file);

}  // namespace dmpc::apps
