// The statements of an OBJ file.
#pragma once

#include <functional>
#include <string_view>

#include "apps/foreign/mesh/scene_totals.h"
#include "apps/foreign/obj/geometry.h"

namespace dmpc::apps::obj {

/// Parses a whole file in one pass (Wavefront, "Advanced Visualizer", appendix B1). `passed` is called now and then with the
/// fraction read. Throws core::InputError, with the line, for invalid values, superfluous numbers or bytes, references to
/// undefined elements, and faces with too many corners; core::CapacityError if indices or memory do not suffice.
Geometry parse_obj(std::string_view file, const std::function<void(float)>& passed, SceneTotals& totals);

}  // namespace dmpc::apps::obj
