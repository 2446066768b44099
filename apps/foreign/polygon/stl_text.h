// STL in text.
#pragma once

#include <string_view>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/polygon/reading_progress.h"

namespace dmpc::apps {

/// Words may be written in letters of any case and on any lines, but for a solid's name, which ends its line. Throws
/// core::InputError with the line.
PlacedFile read_stl_text(std::string_view text, ReadingProgress& progress);

}  // namespace dmpc::apps
