// Binary STL.
#pragma once

#include <string_view>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/polygon/reading_progress.h"

namespace dmpc::apps {

/// Returns whether the file is as long as its facet count implies.
bool is_whole_stl_binary(std::string_view file);

/// The format: a header of 80 bytes, a count, and 50 bytes per facet, of which the last 2 are its attribute. A header with
/// COLOR= (Magics) has the colour of all facets whose attribute is 0 or has its highest bit set; other facets have their own
/// colour: 5 bits each of red, from the lowest bit, green and blue. Without COLOR=, attributes with the highest bit set are
/// colours (VisCAM): 5 bits each of blue, green and red. Throws core::InputError.
PlacedFile read_stl_binary(std::string_view file, ReadingProgress& progress);

}  // namespace dmpc::apps
