// A heat map as files: a picture with a colour for each pixel, and below it a legend.
#pragma once

#include <string>

#include "apps/picture/image_file.h"
#include "apps/run/heat_options.h"
#include "apps/run/render_record.h"
#include "apps/show/heat/field.h"

namespace dmpc::apps {

/// All bytes of the file that is asked for; record.heat has its kind. Throws core::InputError if its format cannot hold it.
std::string heat_file(const HeatRequest& request, const RenderRecord& record);

/// Black: 0 on a logarithmic scale. The legend says what is shown, the scale (apps/frontend/line/scale.h: linear or logarithmic)
/// with round numbers, least, largest and mean, and `source`, such as scene and strategy, on a line of its own. A picture too
/// narrow for its legend gets a white margin on the right; in a wide one each dot of a letter is several pixels wide.
Image heat_picture(const HeatField& field, const std::string& source);

}  // namespace dmpc::apps
