// STL in binary.
#pragma once

#include <string_view>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/polygon/reading_progress.h"

namespace dmpc::apps {

/// Whether it is as long as the count of facets in it says.
bool is_whole_stl_binary(std::string_view file);

/// 80 bytes of header, a count, 50 bytes a facet, of which the last 2 are its attribute. A header with COLOR= (Magics) has the
/// colour of all facets whose attribute is 0 or has its highest bit; others have their own: 5 bits of red, from the lowest, of
/// green and of blue. Without it attributes with the highest bit are colours (VisCAM): 5 bits of blue, green and red. Throws
/// core::InputError.
PlacedFile read_stl_binary(std::string_view file, ReadingProgress& progress);

}  // namespace dmpc::apps
