// Writes a heat map: a picture with a colour for each pixel, and a legend below it.
#pragma once

#include <string>

#include "apps/picture/image_file.h"
#include "apps/run/heat_options.h"
#include "apps/run/render_record.h"
#include "apps/show/heat/field.h"

namespace dmpc::apps {

/// Returns the bytes of the requested file; record.heat has its kind. Throws core::InputError if the format cannot hold it.
std::string heat_file(const HeatRequest& request, const RenderRecord& record);

/// 0 is black on a logarithmic scale. The legend names the quantity, the scale (apps/frontend/line/scale.h: linear or
/// logarithmic) with round numbers, least, largest and mean, and, on a line of its own, `source`, such as scene and strategy. A
/// picture too narrow for its legend gets a white margin on the right; in a wide one each dot of a letter is several pixels wide.
Image heat_picture(const HeatField& field, const std::string& source);

}  // namespace dmpc::apps
