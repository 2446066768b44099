// A few pixels of a picture, rendered to know how long all of them will take.
#pragma once

#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::apps {

/// Processor seconds that one core takes for the picture by the one-thread reference renderer, guessed from pixels all over it;
/// refined samples count as those of the first pass. Takes a quarter of a second at most, and a pixel. `database` has its records
/// still.
double picture_seconds(const core::Database& database, const core::RenderSettings& settings);

}  // namespace dmpc::apps
