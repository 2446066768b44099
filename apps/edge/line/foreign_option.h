// What options of other renderers are called here.
#pragma once

#include <optional>
#include <string>

namespace dmpc::apps {

/// An option of ours that does what another program's does.
struct ForeignOption {
  const char* ours;  ///< "--resolution"
  const char* note;  ///< what of it is meant: "the pixels of both sides"
};

/// Of `name`, as somebody used to pbrt, Mitsuba, Blender, POV-Ray or YafaRay types it: "--fov", "-fov", "-j8", "+W640". Nothing
/// if it is none of those known.
std::optional<ForeignOption> foreign_option(const std::string& name);

}  // namespace dmpc::apps
