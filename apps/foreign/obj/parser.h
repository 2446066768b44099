// The statements of an OBJ file.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "apps/foreign/obj/geometry.h"

namespace dmpc::apps::obj {

/// Reads all of a file in one pass (Wavefront, "Advanced Visualizer", appendix B1). `passed` hears now and then which share lies
/// behind. Throws core::InputError, with the line, for values that are none, a number or a byte too many, what does not exist, or
/// what has too many corners; core::CapacityError for more than indices or memory reach.
Geometry parse_obj(std::string_view file, const std::function<void(float)>& passed, SceneTotals& totals);

}  // namespace dmpc::apps::obj
