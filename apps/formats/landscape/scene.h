// The landscape as a scene of its own, without files.
#pragma once

#include <string_view>

#include "apps/formats/landscape/mesh.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Whether landscape_scene() accepts the name: "landscape-7", "grove", ... Throws core::InputError for a name that begins like
/// that, but continues differently.
bool is_landscape_name(std::string_view name);

/// The scene that write_landscape() or write_grove() write (apps/formats/landscape/names.h), seen from the same camera, except
/// for rounding in the files; the sun stands high on the right. Each kind of tree is one mesh; `copies` says whether its copies
/// are made. Requires a name that is_landscape_name(). Throws core::CapacityError if the trees' copies are more than a database
/// or memory can hold.
core::Scene landscape_scene(std::string_view name, core::Copies copies, const RowsDone& rows_done = {});

}  // namespace dmpc::apps
