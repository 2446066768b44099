// The converged picture by paths, which errors of such pictures are measured against.
#pragma once

#include <cstdint>

#include "apps/lab/oracle/reference/reference.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::apps {

/// The samples of a path reference have these numbers and higher ones, which no picture has that is held against it.
inline constexpr std::uint32_t path_reference_first = 16384;

/// So many samples of each pixel, a power of two from 2 to path_reference_first, by our own arithmetic on all cores, pixel by
/// pixel and never refined. Chances are numbered from path_reference_first on: other ones than those of pictures with fewer
/// samples. Halves are leaves of the pixels' sequences that follow each other; their difference is the reference's own error, as
/// in Reference. The bits are the same for any number of cores. Progress counts rows. Throws Interrupted when a stop is
/// requested.
Reference path_reference(const core::Database& database, const core::RenderSettings& settings, std::uint32_t samples,
                         const Attendance& attendance);

}  // namespace dmpc::apps
