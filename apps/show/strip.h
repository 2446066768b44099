// Six moments of a picture as it came.
#pragma once

#include <string>

#include "apps/picture/image_file.h"
#include "apps/run/render_record.h"
#include "apps/show/heat/field.h"

namespace dmpc::apps {

/// Side by side what of `picture` was done when a sixth, two sixths, ... of the time until its last pixel had passed, each with
/// that time below it, dark where a pixel was not done; and `source`, such as scene and computer, on a line of its own. A larger
/// picture is shrunk to `side_max`. `done` is of the kind of that name, and has as many pixels as the picture.
Image strip_picture(const Image& picture, const HeatField& done, int side_max, const std::string& source);

/// That of a run that has recorded when its pixels were done.
Image strip_picture(const RenderRecord& record, int side_max);

}  // namespace dmpc::apps
