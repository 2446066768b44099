// The picture that covers the landscape's ground.
#pragma once

#include "apps/formats/landscape/mesh.h"
#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// A picture of `side` x `side` texels, the one at the top left at (x, z) = (-1, -1/2); `side` > 0. Computed on all cores; the
/// result does not depend on their number.
Image ground_picture(int side, const RowsDone& rows_done = {});

}  // namespace dmpc::apps
