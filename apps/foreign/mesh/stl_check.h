// Whether an STL file is whole, before Assimp reads it, and what Assimp does not tell of it.
#pragma once

#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError for a file that ends before its end: of text within a facet or before `endsolid`, in binary before as
/// many facets as it says.
void check_stl(std::string_view file);

/// Without the byte order mark with which text may begin.
std::string_view stl_without_mark(std::string_view file);
/// Whether a file in binary names a colour of the whole.
bool has_stl_colour(std::string_view file);

}  // namespace dmpc::apps
