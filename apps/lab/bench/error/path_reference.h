// The converged picture by paths, against which errors of such pictures are measured.
#pragma once

#include <cstdint>

#include "apps/lab/oracle/reference/reference.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::apps {

/// The samples of a path reference have this number and higher ones, which the pictures compared with it never use.
inline constexpr std::uint32_t path_reference_first = 16384;

/// Renders this many samples of each pixel, a power of two from 2 to path_reference_first, by our own arithmetic on all cores,
/// pixel by pixel and without refinement. Random numbers start at index path_reference_first: they differ from those of pictures
/// with fewer samples. The two halves are consecutive parts of the pixels' sequences; their difference is the reference's own
/// error, as in Reference. The bits are the same for any number of cores. Progress counts rows. Throws Interrupted when a stop is
/// requested.
Reference path_reference(const core::Database& database, const core::RenderSettings& settings, std::uint32_t samples,
                         const Attendance& attendance);

}  // namespace dmpc::apps
